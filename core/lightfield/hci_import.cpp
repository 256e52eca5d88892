#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "core/lightfield/folder_views.h"
#include "core/lightfield/hci.h"
#include "core/lightfield/hci_truth.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMaxParameterBytes = 1u << 20;
constexpr float kRounding_px = 0.01f;  // of signed disparity at infinity
constexpr float kDepthEdge_px = 1.0f;

fs::path image_path(const fs::path& folder, int index) {
  return folder / fmt::format("input_Cam{:03}.png", index);
}

// What turns the benchmark's images into those of centred pinholes.
struct Rectification {
  HciParameters parameters;
  ViewGrid grid;
  double focus_px = 0;
  int crop_x = 0, crop_y = 0;

  double shift_x(int column) const { return focus_px * (column - (parameters.columns - 1) / 2.0); }
  double shift_y(int row) const { return focus_px * (row - (parameters.rows - 1) / 2.0); }
};

Rectification rectification_of(const HciParameters& p, const fs::path& folder) {
  Rectification r{.parameters = p, .grid = {}, .focus_px = p.focus_disparity_px()};
  const double crop_x = std::ceil(r.focus_px * (p.columns - 1) / 2.0),
               crop_y = std::ceil(r.focus_px * (p.rows - 1) / 2.0);
  if (2 * crop_x >= p.width || 2 * crop_y >= p.height)
    throw InputError(fmt::format(
        "the views of {} have no area in common: the focus plane is displaced by {:.1f} px a view",
        folder.string(), r.focus_px));
  r.crop_x = static_cast<int>(crop_x);
  r.crop_y = static_cast<int>(crop_y);
  r.grid.columns = p.columns;
  r.grid.rows = p.rows;
  r.grid.spacing_x_m = r.grid.spacing_y_m = p.baseline_mm * 1e-3;
  r.grid.width = p.width - 2 * r.crop_x;
  r.grid.height = p.height - 2 * r.crop_y;
  r.grid.fov_h_deg = 2 * std::atan(r.grid.width / (2 * p.focal_length_px())) * 180 / std::numbers::pi;
  r.grid.validate();
  return r;
}

// The four pixels around a position between pixel centres, and their bilinear weights.
struct Neighbours {
  int x0, y0, x1, y1;
  float fx, fy;
  Neighbours(double x, double y, int width, int height)
      : x0(std::clamp(static_cast<int>(x), 0, width - 1)),
        y0(std::clamp(static_cast<int>(y), 0, height - 1)),
        x1(std::min(x0 + 1, width - 1)),
        y1(std::min(y0 + 1, height - 1)),
        fx(static_cast<float>(x - x0)),
        fy(static_cast<float>(y - y0)) {}

  template <class T>
  T interpolate(const Plane<T>& plane) const {
    return (plane.at(x0, y0) * (1 - fx) + plane.at(x1, y0) * fx) * (1 - fy) +
           (plane.at(x0, y1) * (1 - fx) + plane.at(x1, y1) * fx) * fy;
  }

  float without_mixing_edges(const Plane<float>& plane) const {
    const auto [low, high] =
        std::minmax({plane.at(x0, y0), plane.at(x1, y0), plane.at(x0, y1), plane.at(x1, y1)});
    return high - low > kDepthEdge_px ? plane.at(fx < 0.5f ? x0 : x1, fy < 0.5f ? y0 : y1)
                                      : interpolate(plane);
  }
};

KeyView<DisplayReferred> rectify(const DisplayImage& image, const Plane<float>& signed_disparity,
                                 const Rectification& r, int column, int row) {
  KeyView<DisplayReferred> view;
  view.colour = DisplayImage(r.grid.width, r.grid.height);
  view.disparity = DisparityMap(r.grid.width, r.grid.height);
  for (int y = 0; y < r.grid.height; ++y)
    for (int x = 0; x < r.grid.width; ++x) {
      const Neighbours n(x + r.crop_x + r.shift_x(column), y + r.crop_y + r.shift_y(row), image.width(),
                         image.height());
      view.colour.at(x, y) = n.interpolate(image);
      const float d = n.without_mixing_edges(signed_disparity) + static_cast<float>(r.focus_px);
      view.disparity.at(x, y) = d < 0 && d > -kRounding_px ? 0.0f : d;
    }
  return view;
}

KeyView<DisplayReferred> load_view(const fs::path& folder, const Rectification& r, const HciTruth& truth,
                                   int column, int row) {
  const fs::path path = image_path(folder, row * r.grid.columns + column);
  const DisplayImage image = read_display_image(path);
  if (image.width() != r.parameters.width || image.height() != r.parameters.height)
    throw InputError(fmt::format("{} has {} × {} pixels, but parameters.cfg says {} × {}", path.string(),
                                 image.width(), image.height(), r.parameters.width, r.parameters.height));
  KeyView<DisplayReferred> view = rectify(image, truth(column, row), r, column, row);
  check_disparity(view.disparity, fmt::format("the ground truth for {}", path.string()));
  return view;
}

ViewLoader<DisplayReferred> loader_of(const fs::path& folder, const Rectification& r) {
  for (int i = 0; i < r.grid.columns * r.grid.rows; ++i)
    if (!fs::is_regular_file(image_path(folder, i)))
      throw InputError(fmt::format("{} does not exist, although parameters.cfg announces {} × {} cameras",
                                   image_path(folder, i).string(), r.grid.columns, r.grid.rows));
  return [folder, r, truth = find_hci_truth(folder, r.parameters)](int column, int row) {
    return load_view(folder, r, truth, column, row);
  };
}

Rectification open_parameters(const fs::path& folder) {
  const fs::path file = folder / "parameters.cfg";
  return rectification_of(parse_hci_parameters(read_text_file(file, kMaxParameterBytes), file.string()),
                          folder);
}

}  // namespace

bool is_hci_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "parameters.cfg", error) &&
         fs::is_regular_file(image_path(folder, 0), error);
}

DisplayLightField import_hci(const fs::path& folder, const HciImportOptions& options) {
  const Rectification r = open_parameters(folder);
  return DisplayLightField(r.grid, RadianceUnit::kRelative, folder.string(), loader_of(folder, r),
                           options.memory_bound_bytes);
}

LightField import_hci_linear(const fs::path& folder, const HciImportOptions& options) {
  const Rectification r = open_parameters(folder);
  const auto load = [encoded = loader_of(folder, r)](int column, int row) {
    KeyView<DisplayReferred> display = encoded(column, row);
    KeyView<SceneReferred> scene;
    scene.colour = SceneImage(display.colour.width(), display.colour.height());
    std::transform(display.colour.pixels().begin(), display.colour.pixels().end(),
                   scene.colour.pixels().begin(), [](Rgb c) { return gamma_decode(c); });
    scene.disparity = std::move(display.disparity);
    return scene;
  };
  return LightField(r.grid, RadianceUnit::kRelative, folder.string(), load, options.memory_bound_bytes);
}

}  // namespace plenolab
