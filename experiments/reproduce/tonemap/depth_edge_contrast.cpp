#include "experiments/reproduce/tonemap/depth_edge_contrast.h"

#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

/// Pixels of one side of an edge: from (x, y) on away from it.
struct Side {
  int x, y, step_x, step_y;
};

bool is_one_surface(const DisparityMap& disparity, const Side& side, const DepthEdgeOptions& options) {
  const float first = disparity.at(side.x, side.y);
  for (int i = 1; i < options.side_px; ++i) {
    const int x = side.x + i * side.step_x, y = side.y + i * side.step_y;
    if (x < 0 || y < 0 || x >= disparity.width() || y >= disparity.height()) return false;
    if (!(std::abs(static_cast<double>(disparity.at(x, y) - first)) <= options.same_surface_px)) return false;
  }
  return true;
}

double mean_of(const Plane<float>& plane, const Side& side, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i)
    sum += static_cast<double>(plane.at(side.x + i * side.step_x, side.y + i * side.step_y));
  return sum / count;
}

}  // namespace

DepthEdgeContrast contrast_across_depth_edges(const Plane<float>& log_luminance,
                                              const DisparityMap& disparity,
                                              std::span<const Plane<float>* const> planes,
                                              const DepthEdgeOptions& options) {
  PLENOLAB_CHECK(options.side_px >= 1, "a pixel on each side at least");
  DepthEdgeContrast contrast{.along = std::vector<double>(planes.size())};
  const auto add_pair = [&](int x, int y, int right, int down) {
    const Side a{x, y, -right, -down}, b{x + right, y + down, right, down};
    const auto jump = static_cast<double>(disparity.at(a.x, a.y) - disparity.at(b.x, b.y));
    if (!(std::abs(jump) > options.least_disparity_px)) return;
    if (!is_one_surface(disparity, a, options) || !is_one_surface(disparity, b, options)) return;
    const auto difference = [&](const Plane<float>& plane) {
      return mean_of(plane, a, options.side_px) - mean_of(plane, b, options.side_px);
    };
    const double input = difference(log_luminance);
    if (!(std::abs(input) <= options.most_contrast_log10)) return;
    ++contrast.edges;
    contrast.input += std::abs(input);
    for (std::size_t i = 0; i < planes.size(); ++i)
      contrast.along[i] += std::copysign(1.0, input) * difference(*planes[i]);
  };
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x) {
      if (x + 1 < disparity.width()) add_pair(x, y, 1, 0);
      if (y + 1 < disparity.height()) add_pair(x, y, 0, 1);
    }
  return contrast;
}

}  // namespace plenolab
