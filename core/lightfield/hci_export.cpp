#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "core/io/pfm.h"
#include "core/lightfield/hci.h"
#include "core/lightfield/new_folder.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr double kSensor_mm = 35;  // as in the benchmark; only its ratio to the focal length matters

struct Layout {
  ViewGrid grid;
  int focus_px = 0;
  int crop_x = 0, crop_y = 0;
  int width() const { return grid.width - 2 * crop_x; }
  int height() const { return grid.height - 2 * crop_y; }
  int centre() const { return grid.rows / 2 * grid.columns + grid.columns / 2; }
};

std::pair<float, float> disparity_range(const DisplayLightField& light_field) {
  float low = std::numeric_limits<float>::infinity(), high = 0;
  const ViewGrid& grid = light_field.grid();
  for (int i = 0; i < grid.columns * grid.rows; ++i) {
    const auto view = light_field.view(i % grid.columns, i / grid.columns);
    const auto [least, most] =
        std::minmax_element(view->disparity.pixels().begin(), view->disparity.pixels().end());
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  return {low, high};
}

Layout layout_of(const DisplayLightField& light_field, int focus_px) {
  Layout layout{.grid = light_field.grid(), .focus_px = focus_px};
  const ViewGrid& grid = layout.grid;
  if (grid.columns % 2 == 0 || grid.rows % 2 == 0)
    throw InputError(fmt::format("the HCI layout needs a centre view, but {} has {} × {} views",
                                 light_field.name(), grid.columns, grid.rows));
  if (std::abs(grid.vertical_ratio() - 1) > 1e-9)
    throw InputError(fmt::format("the HCI layout needs equal spacings, but {} has {} × {} m",
                                 light_field.name(), grid.spacing_x_m, grid.spacing_y_m));
  if (focus_px < 0)
    throw InputError(fmt::format("the disparity of the focus plane must be ≥ 0, not {}", focus_px));
  const std::int64_t crop_x = std::int64_t{focus_px} * (grid.columns / 2),
                     crop_y = std::int64_t{focus_px} * (grid.rows / 2);
  if (2 * crop_x >= grid.width || 2 * crop_y >= grid.height)
    throw InputError(fmt::format(
        "the views of {} have no area in common when the focus plane is displaced by {} px a view",
        light_field.name(), focus_px));
  layout.crop_x = static_cast<int>(crop_x);
  layout.crop_y = static_cast<int>(crop_y);
  return layout;
}

std::string format_parameters(const Layout& layout, const std::string& name, std::pair<float, float> range) {
  const ViewGrid& grid = layout.grid;
  const double focal_px = grid.width / (2 * std::tan(grid.fov_h_deg * std::numbers::pi / 360));
  const double focal_mm = focal_px * kSensor_mm / std::max(layout.width(), layout.height());
  const double focus_m = layout.focus_px > 0 ? grid.spacing_x_m * focal_px / layout.focus_px
                                             : std::numeric_limits<double>::infinity();
  return fmt::format(
      "[intrinsics]\nfocal_length_mm = {}\nimage_resolution_x_px = {}\nimage_resolution_y_px = "
      "{}\nsensor_size_mm = {}\n"
      "fstop = 100\n\n[extrinsics]\nnum_cams_x = {}\nnum_cams_y = {}\nbaseline_mm = {}\nfocus_distance_m = "
      "{}\n"
      "center_cam_x_m = 0\ncenter_cam_y_m = 0\ncenter_cam_z_m = 0\ncenter_cam_rx_rad = 0\ncenter_cam_ry_rad "
      "= 0\n"
      "center_cam_rz_rad = 0\n\n[meta]\nscene = {}\ncategory = plenolab\nversion = v0\ndisp_min = "
      "{}\ndisp_max = {}\n",
      focal_mm, layout.width(), layout.height(), kSensor_mm, grid.columns, grid.rows, grid.spacing_x_m * 1e3,
      focus_m, fs::path(name).filename().string(), range.first - static_cast<float>(layout.focus_px),
      range.second - static_cast<float>(layout.focus_px));
}

void write_view(const fs::path& folder, const DisplayLightField& light_field, const Layout& layout, int index,
                bool all_truth) {
  const int column = index % layout.grid.columns, row = index / layout.grid.columns;
  const auto view = light_field.view(column, row);
  const int left = layout.crop_x - layout.focus_px * (column - layout.grid.columns / 2);
  const int top = layout.crop_y - layout.focus_px * (row - layout.grid.rows / 2);
  DisplayImage image(layout.width(), layout.height());
  Plane<float> disparity(layout.width(), layout.height());
  for (int y = 0; y < layout.height(); ++y)
    for (int x = 0; x < layout.width(); ++x) {
      image.at(x, y) = view->colour.at(x + left, y + top);
      disparity.at(x, y) = view->disparity.at(x + left, y + top) - static_cast<float>(layout.focus_px);
    }
  write_display_image(folder / fmt::format("input_Cam{:03}.png", index), image);
  if (all_truth) write_pfm(folder / fmt::format("gt_disp_lowres_Cam{:03}.pfm", index), disparity);
  if (index == layout.centre()) write_pfm(folder / "gt_disp_lowres.pfm", disparity);
}

}  // namespace

void export_hci(const fs::path& folder, const DisplayLightField& light_field, const HciExportOptions& options,
                const Progress& progress) {
  const std::pair<float, float> range = disparity_range(light_field);
  const int middle = static_cast<int>(std::lround((double{range.first} + range.second) / 2));
  const Layout layout = layout_of(light_field, options.focus_disparity_px.value_or(middle));
  const int views = layout.grid.columns * layout.grid.rows;
  write_folder_atomically(folder, [&](const fs::path& temporary) {
    for (int i = 0; i < views; ++i) {
      write_view(temporary, light_field, layout, i, options.all_ground_truth);
      if (progress) progress((i + 1.0) / views);
    }
    write_text_file(temporary / "parameters.cfg", format_parameters(layout, light_field.name(), range));
  });
}

}  // namespace plenolab
