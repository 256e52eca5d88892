#pragma once

#include <filesystem>
#include <optional>

namespace plenolab {

/// Luminance in cd/m² of the value (1, 1, 1) as an .exr says by its attribute whiteLuminance. Nothing for
/// other files, without the attribute, or if it is not a finite number above 0. Throws InputError for a
/// damaged .exr.
std::optional<double> white_luminance(const std::filesystem::path& path);

}  // namespace plenolab
