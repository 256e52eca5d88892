#pragma once

#include "core/image/image.h"

namespace plenolab {

/// Smallest and largest value of a plane.
struct Bounds {
  float min = 0, max = 0;
  bool usable = true;  ///< no value is NaN or larger than kLargestFiltered

  double range() const { return static_cast<double>(max) - static_cast<double>(min); }
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// Differences of larger magnitudes than this would overflow when squared.
inline constexpr float kLargestFiltered = 1e18f;

/// At least one value. Min and max are those of the values that are not NaN.
Bounds bounds_of(const Plane<float>& plane);

}  // namespace plenolab
