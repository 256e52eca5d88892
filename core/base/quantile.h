#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/error.h"

namespace plenolab {

/// Quantile p in [0, 1] of values sorted in ascending order, linear between neighbours (type 7 of Hyndman &
/// Fan 1996, the default of R and NumPy). At least one value, none NaN.
template <class T>
double quantile_of_sorted(std::span<const T> sorted, double p) {
  PLENOLAB_CHECK(!sorted.empty() && p >= 0 && p <= 1, "a quantile needs a value and p in [0, 1]");
  const double position = p * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(std::floor(position));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double weight = position - static_cast<double>(below);
  // No difference of equal values: infinite neighbours must not give NaN.
  if (weight == 0 || sorted[below] == sorted[above]) return static_cast<double>(sorted[below]);
  return static_cast<double>(sorted[below]) * (1 - weight) + static_cast<double>(sorted[above]) * weight;
}

}  // namespace plenolab
