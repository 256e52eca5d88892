#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "experiments/reproduce/claims/probes.h"
#include "stimuli/block_preprocess.h"

namespace plenolab {

namespace {

/// Surfaces from near to far, so that the first that covers a sample is the one seen.
std::vector<const FlatSurface*> near_to_far(const FlatWorld& world) {
  std::vector<const FlatSurface*> order;
  for (const FlatSurface& surface : world.surfaces) order.push_back(&surface);
  std::stable_sort(order.begin(), order.end(), [](const FlatSurface* a, const FlatSurface* b) {
    return a->disparity_px > b->disparity_px;
  });
  return order;
}

/// Whether no point of the pixel lies within the bounds of the surface.
bool is_beside(const FlatSurface& surface, CameraPosition shift, int x, int y) {
  const double left = x + shift.s * surface.disparity_px, top = y + shift.t * surface.disparity_px;
  return left > surface.bounds.right || left + 1 < surface.bounds.left || top > surface.bounds.bottom ||
         top + 1 < surface.bounds.top;
}

/// The plain and endless surface that alone is seen in the pixel, if there is one: most pixels need no
/// samples.
const FlatSurface* only_surface(const std::vector<const FlatSurface*>& order, CameraPosition shift, int x,
                                int y) {
  for (const FlatSurface* surface : order) {
    if (is_beside(*surface, shift, x, y)) continue;
    return surface->is_endless() && std::holds_alternative<Rgb>(surface->colour) ? surface : nullptr;
  }
  return nullptr;
}

/// One pixel of a view: 4 × 4 samples, reduced as those of rendered views.
BlockPixel block_at(const std::vector<const FlatSurface*>& order, CameraPosition shift, int x, int y) {
  if (const FlatSurface* only = only_surface(order, shift, x, y))
    return {std::get<Rgb>(only->colour), static_cast<float>(only->disparity_px)};
  std::array<Rgb, kBlockSamples> radiance{};
  std::array<float, kBlockSamples> disparity{};
  for (std::size_t i = 0; i < kBlockSamples; ++i) {
    const double px = x + (i % kBlockSide + 0.5) / kBlockSide, py = y + (i / kBlockSide + 0.5) / kBlockSide;
    for (const FlatSurface* surface : order) {
      // q = p + (F_p − F_q)·disp(p): the point seen here as the origin's view sees it.
      const double qx = px + shift.s * surface->disparity_px, qy = py + shift.t * surface->disparity_px;
      if (!surface->is_at(qx, qy)) continue;
      radiance[i] = surface->colour_at(qx, qy);
      disparity[i] = static_cast<float>(surface->disparity_px);
      break;
    }
  }
  return preprocess_block(radiance, disparity, {});
}

constexpr int kPatternPeriod = 64;  ///< colours of a pattern along each axis

/// The random colours of a pattern.
std::vector<Rgb> pattern_colours(std::uint32_t seed) {
  std::vector<Rgb> colours(kPatternPeriod * kPatternPeriod);
  RandomStream random(seed, 0x7061747465726eu, 0);
  for (Rgb& colour : colours) {
    const float tone = 0.12f + 0.8f * random.next_float();
    for (float* channel : {&colour.r, &colour.g, &colour.b})
      *channel = tone + 0.16f * (random.next_float() - 0.5f);
  }
  return colours;
}

}  // namespace

KeyView<SceneReferred> flat_view(const FlatWorld& world, const ViewGrid& grid, CameraPosition position,
                                 int threads) {
  KeyView<SceneReferred> view{SceneImage(grid.width, grid.height), DisparityMap(grid.width, grid.height)};
  const CameraPosition shift{position.s - world.origin.s,
                             (position.t - world.origin.t) * grid.vertical_ratio()};
  const auto order = near_to_far(world);
  parallel_for(grid.height, 4, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < grid.width; ++x) {
        const BlockPixel pixel = block_at(order, shift, x, y);
        view.colour.at(x, y) = pixel.radiance;
        view.disparity.at(x, y) = pixel.disparity_px;
      }
  });
  return view;
}

LightField flat_light_field(const FlatWorld& world, const ViewGrid& grid, const std::string& name,
                            int threads) {
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      views.push_back(
          flat_view(world, grid, {static_cast<double>(column), static_cast<double>(row)}, threads));
  return LightField::from_views(grid, RadianceUnit::kRelative, name, std::move(views));
}

ViewGrid probe_grid(int columns, int rows, double spacing_m, int width, int height) {
  return {.columns = columns,
          .rows = rows,
          .spacing_x_m = spacing_m,
          .spacing_y_m = spacing_m,
          .width = width,
          .height = height,
          .fov_h_deg = 60};
}

FlatColour flat_pattern(double feature_px, std::uint32_t seed) {
  return [feature_px, colours = std::make_shared<const std::vector<Rgb>>(pattern_colours(seed))](double x,
                                                                                                 double y) {
    const auto cell = [&](double v, float& between) {
      const double whole = std::floor(v / feature_px);
      const auto t = static_cast<float>(v / feature_px - whole);
      between = t * t * (3 - 2 * t);
      return static_cast<int>(whole) & (kPatternPeriod - 1);
    };
    float u = 0, v = 0;
    const int i = cell(x, u), j = cell(y, v);
    const auto at = [&](int column, int row) {
      return (*colours)[static_cast<std::size_t>((row & (kPatternPeriod - 1)) * kPatternPeriod +
                                                 (column & (kPatternPeriod - 1)))];
    };
    const Rgb upper = at(i, j) * (1 - u) + at(i + 1, j) * u;
    const Rgb lower = at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u;
    return upper * (1 - v) + lower * v;
  };
}

}  // namespace plenolab
