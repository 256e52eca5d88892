#pragma once

#include <filesystem>

#include "experiments/session/study.h"

namespace plenolab {

/// A study of two blocks with three images (one a catch trial) of 2 × 2 px, written to `folder`.
StudyDefinition write_tiny_study(const std::filesystem::path& folder, SessionMode mode = SessionMode::kPilot);

}  // namespace plenolab
