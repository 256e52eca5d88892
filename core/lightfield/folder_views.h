#pragma once

#include <filesystem>
#include <string>

#include "core/lightfield/description.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// Depth from which on a surface counts as infinitely far; renderers write 1e10 for the background.
inline constexpr float kInfiniteDepth_m = 1e9f;

/// Checks by their headers that all views of a description exist in `folder`, have the size and the channels
/// it says. Throws InputError naming the first file that does not.
void check_view_files(const std::filesystem::path& folder, const LightFieldDescription& description);

/// The same for one file.
void check_view_file(const std::filesystem::path& path, const LightFieldDescription& description);

/// Path of view (column, row) by the description's pattern.
std::filesystem::path view_path(const std::filesystem::path& folder, const LightFieldDescription& description,
                                int column, int row);

/// Reads one view by the description's channels; depth becomes disparity. Throws InputError as
/// open_light_field says.
template <class Referral>
KeyView<Referral> read_view_file(const std::filesystem::path& path, const LightFieldDescription& description);

/// Turns planar depth into disparity in place. Throws InputError naming `file` for depth ≤ 0 or NaN.
void depth_to_disparity(Plane<float>& plane, const ViewGrid& grid, const std::string& file);

/// Throws InputError naming `file`, the pixel and the value for negative, infinite or NaN disparity.
void check_disparity(const Plane<float>& disparity, const std::string& file);

}  // namespace plenolab
