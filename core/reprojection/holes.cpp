#include "core/reprojection/holes.h"

#include <limits>

namespace plenolab::reprojection {

namespace {

bool is_hole(float disparity_px) {
  return disparity_px < 0;
}

Rgb mean_of_corners(const Subimage& target, std::span<const Rgb* const> corners, int x, int y) {
  Rgb sum;
  for (const Rgb* corner : corners) sum += corner[y * target.stride + x];
  return sum * (1.0f / static_cast<float>(corners.size()));
}

void fill_by_mean(const Subimage& target, std::span<const Rgb* const> corners) {
  for (int y = 0; y < target.size_px; ++y)
    for (int x = 0; x < target.size_px; ++x)
      if (is_hole(target.disparity_px[static_cast<std::ptrdiff_t>(y) * target.size_px + x]))
        target.colour[y * target.stride + x] = mean_of_corners(target, corners, x, y);
}

/// Fills each run of holes of a row from the filled pixels at its ends; `left_is_taken(left, right, x)`
/// chooses where there are both. Rows of nothing but holes get the mean of the corners.
template <class Choose>
void fill_runs(const Subimage& target, std::span<const Rgb* const> corners, Choose left_is_taken) {
  const int n = target.size_px;
  for (int y = 0; y < n; ++y) {
    Rgb* colour = target.colour + y * target.stride;
    const float* disparity = target.disparity_px + static_cast<std::ptrdiff_t>(y) * target.size_px;
    for (int x = 0; x < n;) {
      if (!is_hole(disparity[x])) {
        ++x;
        continue;
      }
      const int left = x - 1;
      int right = x;
      while (right < n && is_hole(disparity[right])) ++right;
      for (; x < right; ++x) {
        if (left < 0 && right == n)
          colour[x] = mean_of_corners(target, corners, x, y);
        else
          colour[x] = left >= 0 && (right == n || left_is_taken(disparity, left, right, x)) ? colour[left]
                                                                                            : colour[right];
      }
    }
  }
}

/// The nearest filled pixel by steps to neighbours: forwards then backwards (Rosenfeld & Pfaltz 1966).
void fill_by_nearest(const Subimage& target, std::span<const Rgb* const> corners) {
  const int n = target.size_px;
  constexpr int kFar = std::numeric_limits<int>::max() / 2;
  Plane<int> steps(n, n, kFar);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      if (!is_hole(target.disparity_px[static_cast<std::ptrdiff_t>(y) * target.size_px + x]))
        steps.at(x, y) = 0;
  const auto draw_from = [&](int x, int y, int from_x, int from_y) {
    if (from_x < 0 || from_y < 0 || from_x >= n || from_y >= n ||
        steps.at(from_x, from_y) + 1 >= steps.at(x, y))
      return;
    steps.at(x, y) = steps.at(from_x, from_y) + 1;
    target.colour[y * target.stride + x] = target.colour[from_y * target.stride + from_x];
  };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) draw_from(x, y, x - 1, y), draw_from(x, y, x, y - 1);
  for (int y = n - 1; y >= 0; --y)
    for (int x = n - 1; x >= 0; --x) draw_from(x, y, x + 1, y), draw_from(x, y, x, y + 1);
  if (steps.at(0, 0) >= kFar) fill_by_mean(target, corners);
}

void fill_with_black(const Subimage& target) {
  for (int y = 0; y < target.size_px; ++y)
    for (int x = 0; x < target.size_px; ++x)
      if (is_hole(target.disparity_px[static_cast<std::ptrdiff_t>(y) * target.size_px + x]))
        target.colour[y * target.stride + x] = {};
}

}  // namespace

void fill_holes(const Subimage& target, HoleFill fill, std::span<const Rgb* const> corners) {
  switch (fill) {
    case HoleFill::kMean:
      return fill_by_mean(target, corners);
    case HoleFill::kEdge:
      return fill_runs(target, corners,
                       [](const float*, int left, int right, int x) { return x - left <= right - x; });
    case HoleFill::kBackground:
      return fill_runs(target, corners, [](const float* disparity, int left, int right, int) {
        return disparity[left] <= disparity[right];
      });
    case HoleFill::kNearest:
      return fill_by_nearest(target, corners);
    case HoleFill::kBlack:
      return fill_with_black(target);
  }
}

}  // namespace plenolab::reprojection
