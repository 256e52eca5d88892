#include "core/synthesis/thin_structures.h"

#include <algorithm>
#include <cmath>

namespace plenolab {
namespace {

bool is_edge(const PreparedView& view, int x, int y, float threshold) {
  const float centre = view.disparity_row(y)[x];
  for (int dy = -1; dy <= 0; ++dy)
    for (int dx = -1; dx <= 0; ++dx) {  // the padding repeats the outermost pixels
      const float *upper = view.disparity_row(y + dy) + x + dx,
                  *lower = view.disparity_row(y + dy + 1) + x + dx;
      const float farthest = std::min(std::min(upper[0], upper[1]), std::min(lower[0], lower[1]));
      if (centre - farthest > threshold) return true;
    }
  return false;
}

/// What one view shows of a pixel.
struct Sight {
  bool surface = false;  ///< in frustum and past rule 2
  float disparity = 0;   ///< of the surface the search found
  float thin = -1;       ///< of an edge pixel in front of it, or −1
};

Sight look(const BlendSetup& setup, const PatchView& view, const PreparedView& prepared, int n, float thin) {
  Sight sight;
  const Hit hit = view.hits.get(n);
  if (hit.found()) sight.disparity = bilinear_disparity(prepared, hit.i, hit.j, hit.fx, hit.fy);
  sight.surface = hit.found() && view.range[n] <= static_cast<float>(setup.options.disocclusion_px);
  const bool in_front = thin > sight.disparity + static_cast<float>(setup.options.occlusion_margin_px);
  if (thin >= 0 && (!hit.found() || in_front)) sight.thin = thin;
  return sight;
}

/// Whether the views agree that a surface of disparity `front` is there.
bool agreed(const BlendSetup& setup, const std::array<Sight, kMaxViews>& sights, float front) {
  const float margin = static_cast<float>(setup.options.occlusion_margin_px);
  double support = 0, total = 0;
  for (int v = 0; v < setup.count; ++v) {
    const Sight& sight = sights[static_cast<std::size_t>(v)];
    if (sight.thin < 0 && !sight.surface) continue;
    const double weight = setup.used[static_cast<std::size_t>(v)].weight;
    total += weight;
    if (std::max(sight.thin, sight.surface ? sight.disparity : -1) >= front - margin) support += weight;
  }
  return total > 0 && support >= 0.5 * total;
}

}  // namespace

ThinSplats splat_edge_pixels(const PreparedView& view, const EpipolarPath& path, double disocclusion_px) {
  ThinSplats splats{Plane<float>(view.width, view.height, -1.0f), Plane<int>(view.width, view.height, -1)};
  const auto threshold = static_cast<float>(disocclusion_px);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      if (!is_edge(view, x, y, threshold)) continue;
      const float disparity = view.disparity_row(y)[x];
      const double to_x = std::floor(x - path.sx - path.vx * disparity + 0.5);
      const double to_y = std::floor(y - path.sy - path.vy * disparity + 0.5);
      if (to_x < 0 || to_x >= view.width || to_y < 0 || to_y >= view.height) continue;
      float& nearest = splats.disparity.at(static_cast<int>(to_x), static_cast<int>(to_y));
      if (disparity <= nearest) continue;
      nearest = disparity;
      splats.source.at(static_cast<int>(to_x), static_cast<int>(to_y)) = y * view.width + x;
    }
  return splats;
}

std::uint64_t keep_edge_pixels(const BlendSetup& setup,
                               const std::array<std::unique_ptr<ThinSplats>, kMaxViews>& splats,
                               const Patch& patch, PatchViews& views) {
  std::uint64_t kept = 0;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x) {
      const int n = y * Patch::kMaxWidth + x;
      std::array<Sight, kMaxViews> sights;
      float front = -1;
      for (std::size_t v = 0; v < kMaxViews; ++v) {
        if (static_cast<int>(v) >= setup.count) continue;
        views.views[v].thin[n] = 0;
        const float thin = splats[v]->disparity.at(patch.x + x, patch.y + y);
        sights[v] = look(setup, views.views[v], *setup.prepared[v], n, thin);
        front = std::max(front, sights[v].thin);
      }
      if (front < 0 || !agreed(setup, sights, front)) continue;
      for (std::size_t v = 0; v < kMaxViews; ++v) {
        if (sights[v].thin < 0) continue;
        const int source = splats[v]->source.at(patch.x + x, patch.y + y), width = setup.prepared[v]->width;
        views.views[v].hits.set(n, {source % width, source / width, 0, 0});
        views.views[v].thin[n] = 1;
        ++kept;
      }
    }
  return kept;
}

}  // namespace plenolab
