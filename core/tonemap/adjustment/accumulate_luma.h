#pragma once

#include <cstdint>

#include "core/tonemap/adjustment/adjustment_view.h"

namespace plenolab {

/// One view that the pixels of another look into.
struct LumaSource {
  const AdjustmentView& view;
  ViewStep step;
  float distance_exponent;  ///< W_s = 2^−this
};

/// Exponents of the weights: 2^(−k·difference²).
struct LumaExponents {
  float disparity, log_luminance;
};

/// Sums of one view over the correspondence map: weights, and weights times the difference to the own luma,
/// so that equal lumas leave a factor of exactly 1.
struct LumaSums {
  Plane<float> weight, difference;
};

/// Adds what row `y` of `target` sees in `source` to the sums; returns how many of its pixels lie inside.
std::int64_t accumulate_row(const AdjustmentView& target, const LumaSource& source,
                            const LumaExponents& exponents, int y, LumaSums& sums);

}  // namespace plenolab
