#include "experiments/reproduce/display/edge_distance.h"

#include <algorithm>
#include <cmath>

namespace plenolab {

Mask depth_edges(const Plane<float>& disparity_px, const SubimageLayout& rendered, int factor,
                 float edge_px) {
  Mask edges(rendered.width() / factor, rendered.height() / factor, 0);
  const int n = rendered.size_px;
  for (int y = 0; y < rendered.height(); ++y)
    for (int x = 0; x < rendered.width(); ++x) {
      const auto jumps_from = [&](int from_x, int from_y) {
        return std::abs(disparity_px.at(x, y) - disparity_px.at(from_x, from_y)) > edge_px;
      };
      if ((x % n > 0 && jumps_from(x - 1, y)) || (y % n > 0 && jumps_from(x, y - 1)))
        edges.at(x / factor, y / factor) = 1;
    }
  return edges;
}

Mask holes_with_ring(const Plane<float>& taken_px, const SubimageLayout& rendered, int factor) {
  Mask holes(rendered.width() / factor, rendered.height() / factor, 0);
  const int n = rendered.size_px / factor;
  const auto mark_around = [&](int x, int y) {
    for (int j = std::max(y - 1, y / n * n); j <= std::min(y + 1, y / n * n + n - 1); ++j)
      for (int i = std::max(x - 1, x / n * n); i <= std::min(x + 1, x / n * n + n - 1); ++i)
        holes.at(i, j) = 1;
  };
  for (int y = 0; y < rendered.height(); ++y)
    for (int x = 0; x < rendered.width(); ++x)
      if (taken_px.at(x, y) < 0) mark_around(x / factor, y / factor);
  return holes;
}

Plane<int> steps_to_marked(const Mask& marked, int size_px) {
  Plane<int> steps(marked.width(), marked.height(), kNoneMarked);
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked.pixels()[i] != 0) steps.pixels()[i] = 0;
  const auto draw = [&](int x, int y, int from_x, int from_y) {
    steps.at(x, y) = std::min(steps.at(x, y), std::min(kNoneMarked, steps.at(from_x, from_y) + 1));
  };
  for (int y = 0; y < marked.height(); ++y)
    for (int x = 0; x < marked.width(); ++x) {
      if (x % size_px > 0) draw(x, y, x - 1, y);
      if (y % size_px > 0) draw(x, y, x, y - 1);
    }
  for (int y = marked.height() - 1; y >= 0; --y)
    for (int x = marked.width() - 1; x >= 0; --x) {
      if (x % size_px < size_px - 1) draw(x, y, x + 1, y);
      if (y % size_px < size_px - 1) draw(x, y, x, y + 1);
    }
  return steps;
}

}  // namespace plenolab
