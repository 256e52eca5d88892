#include <algorithm>

#include "core/base/parallel.h"
#include "experiments/reproduce/claims/probes.h"
#include "stimuli/block_preprocess.h"
#include "stimuli/scenes/modelling/noise.h"

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

}  // namespace

KeyView<SceneReferred> flat_view(const FlatWorld& world, const ViewGrid& grid, CameraPosition position,
                                 int threads) {
  const auto order = near_to_far(world);
  SceneImage radiance(grid.width * kBlockSide, grid.height * kBlockSide);
  DisparityMap disparity(radiance.width(), radiance.height());
  const double ds = position.s - world.origin.s, dt = (position.t - world.origin.t) * grid.vertical_ratio();
  parallel_for(radiance.height(), 16, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < radiance.width(); ++x) {
        const double px = (x + 0.5) / kBlockSide, py = (y + 0.5) / kBlockSide;
        for (const FlatSurface* surface : order) {
          // q = p + (F_p − F_q)·disp(p): the point seen here as the origin's view sees it.
          const double qx = px + ds * surface->disparity_px, qy = py + dt * surface->disparity_px;
          if (!surface->is_at(qx, qy)) continue;
          radiance.at(x, y) = surface->colour(qx, qy);
          disparity.at(x, y) = static_cast<float>(surface->disparity_px);
          break;
        }
      }
  });
  return preprocess_blocks(radiance, disparity);
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

std::function<Rgb(double x, double y)> flat_pattern(double feature_px, std::uint32_t seed) {
  return [=](double x, double y) {
    // The second octave of the noise is twice as fine: its features are `feature_px` wide.
    const auto tone = [&](std::uint32_t channel) {
      const Vec3 p{static_cast<float>(x / (2 * feature_px)), static_cast<float>(y / (2 * feature_px)), 0.5f};
      return 0.52f + 0.48f * std::clamp(fractal_noise(p, 2, seed * 3 + channel), -1.f, 1.f);
    };
    return Rgb{tone(0), tone(1), tone(2)};
  };
}

}  // namespace plenolab
