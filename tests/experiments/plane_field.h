#pragma once

#include <filesystem>
#include <string>

#include "core/lightfield/light_field.h"
#include "tests/experiments/run_program.h"

namespace plenolab {

/// A textured plane at `disparity_px`, seen by 3×3 cameras; `sign` −1 makes views that move the wrong way.
LightField plane_field(float disparity_px, double sign = 1);

/// That of 3 px, written to `folder`, which is returned.
std::filesystem::path written_plane(const std::filesystem::path& folder, double sign = 1);

/// The promise of every failure: its exit status (1 failed, 2 wrong use), one line on stderr that mentions
/// what it is about.
void expect_one_clear_sentence(const ProgramResult& result, const std::string& mentions, int status = 1);

}  // namespace plenolab
