#include "core/tonemap/filters/bounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace plenolab {
namespace {

/// Values looked at together; the loop over them becomes vector instructions.
constexpr std::size_t kLanes = 8;

}  // namespace

Bounds bounds_of(const Plane<float>& plane) {
  const std::size_t size = plane.size();
  const float* values = plane.pixels().data();
  float min[kLanes], max[kLanes], poison[kLanes];
  std::fill_n(min, kLanes, std::numeric_limits<float>::infinity());
  std::fill_n(max, kLanes, -std::numeric_limits<float>::infinity());
  std::fill_n(poison, kLanes, 0.0f);
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float v = values[i + lane];
      min[lane] = v < min[lane] ? v : min[lane];
      max[lane] = v > max[lane] ? v : max[lane];
      poison[lane] += v * 0.0f;  // NaN for NaN and infinity
    }
  Bounds bounds{*std::min_element(min, min + kLanes), *std::max_element(max, max + kLanes)};
  float nan = std::accumulate(poison, poison + kLanes, 0.0f);
  for (; i < size; ++i) {
    bounds.min = std::min(bounds.min, values[i]);
    bounds.max = std::max(bounds.max, values[i]);
    nan += values[i] * 0.0f;
  }
  bounds.usable = !std::isnan(nan) && bounds.min >= -kLargestFiltered && bounds.max <= kLargestFiltered;
  return bounds;
}

}  // namespace plenolab
