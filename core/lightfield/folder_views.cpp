#include "core/lightfield/folder_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/io/exr.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

template <class Value>
[[noreturn]] void wrong_pixel(const std::string& file, const Plane<float>& plane, std::size_t index,
                              Value what) {
  const std::size_t width = static_cast<std::size_t>(plane.width());
  throw InputError(fmt::format("{}: {} {} at pixel ({}, {})", file, what, plane.pixels()[index],
                               index % width, index / width));
}

}  // namespace

fs::path view_path(const fs::path& folder, const LightFieldDescription& description, int column, int row) {
  return folder /
         expand_view_pattern(description.view_pattern, column, row, (folder / kDescriptionFile).string());
}

void check_view_file(const fs::path& path, const LightFieldDescription& d) {
  const std::vector<ExrPartInfo> parts = read_exr_header(path);
  const auto has_all = [&](const ExrPartInfo& part) {
    return part.has_channel(d.r) && part.has_channel(d.g) && part.has_channel(d.b) &&
           part.has_channel(d.geometry);
  };
  const auto part = std::find_if(parts.begin(), parts.end(), has_all);
  if (part == parts.end()) {
    for (const std::string& channel : {d.r, d.g, d.b, d.geometry})
      if (std::none_of(parts.begin(), parts.end(),
                       [&](const ExrPartInfo& p) { return p.has_channel(channel); }))
        throw InputError(fmt::format("{} has no channel \"{}\", which {} asks for", path.string(), channel,
                                     kDescriptionFile));
    throw InputError(fmt::format("{} has the channels that {} asks for in different parts", path.string(),
                                 kDescriptionFile));
  }
  if (part->width != d.grid.width || part->height != d.grid.height)
    throw InputError(fmt::format("{} has {} × {} pixels, but {} says {} × {}", path.string(), part->width,
                                 part->height, kDescriptionFile, d.grid.width, d.grid.height));
}

void check_view_files(const fs::path& folder, const LightFieldDescription& description) {
  for (int row = 0; row < description.grid.rows; ++row)
    for (int column = 0; column < description.grid.columns; ++column)
      check_view_file(view_path(folder, description, column, row), description);
}

void depth_to_disparity(Plane<float>& plane, const ViewGrid& grid, const std::string& file) {
  const double at_one_metre = grid.disparity_px(1.0);
  for (std::size_t i = 0; i < plane.size(); ++i) {
    float& value = plane.pixels()[i];
    if (!(value > 0))
      wrong_pixel(file, plane, i, "depth must be positive (infinite for the background), but is");
    value = value >= kInfiniteDepth_m ? 0.0f : static_cast<float>(at_one_metre / value);
    if (!std::isfinite(value))
      throw InputError(fmt::format("{}: a depth is too small for a finite disparity", file));
  }
}

void check_disparity(const Plane<float>& disparity, const std::string& file) {
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    const float value = disparity.pixels()[i];
    if (value < 0)
      wrong_pixel(file, disparity, i, "disparity has the wrong sign (it must be ≥ 0, 0 = infinitely far):");
    if (!std::isfinite(value)) wrong_pixel(file, disparity, i, "disparity must be finite, but is");
  }
}

template <class Referral>
KeyView<Referral> read_view_file(const fs::path& path, const LightFieldDescription& d) {
  std::vector<Plane<float>> planes = read_exr_channels(path, {d.r, d.g, d.b, d.geometry});
  KeyView<Referral> view;
  view.colour = RgbImage<Referral>(planes[0].width(), planes[0].height());
  for (std::size_t i = 0; i < view.colour.size(); ++i)
    view.colour.pixels()[i] = {planes[0].pixels()[i], planes[1].pixels()[i], planes[2].pixels()[i]};
  view.disparity = std::move(planes[3]);
  if (d.geometry_kind == GeometryChannel::kDepth_m) depth_to_disparity(view.disparity, d.grid, path.string());
  check_disparity(view.disparity, path.string());
  return view;
}

template KeyView<SceneReferred> read_view_file(const fs::path&, const LightFieldDescription&);
template KeyView<DisplayReferred> read_view_file(const fs::path&, const LightFieldDescription&);

}  // namespace plenolab
