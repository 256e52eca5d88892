#pragma once

#include <filesystem>

#include "experiments/session/study.h"

namespace plenolab {

/// Reads FILE, or FILE/study.json if it is a folder, and hashes its images. Throws InputError, also if an
/// image file is missing, or a test image is the same as its reference (every choice would be as good) in an
/// image that does not say so by "identical".
StudyDefinition read_study(const std::filesystem::path& file);

/// The study file itself and its folder, where its images are.
std::filesystem::path study_file(const std::filesystem::path& file_or_folder);
std::filesystem::path study_folder(const std::filesystem::path& file_or_folder);

}  // namespace plenolab
