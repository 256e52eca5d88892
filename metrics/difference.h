#pragma once

#include <string>

#include "metrics/comparison.h"

namespace plenolab {

/// Statistics of the differences (test − reference) of encoded values, clamp(exposure·C, 0, 1)^(1/2.2), or of
/// display values as they are, per channel c = r, g, b over the valid pixels:
///   mean_difference_c        bias, in [−1, 1]
///   mean_abs_difference_c    rms_difference_c    max_abs_difference_c
///   abs_difference_p50_c     abs_difference_p95_c     abs_difference_p99_c   quantiles (linear between
///   ranks) share_above_threshold_c  share of pixels whose absolute difference exceeds
///   conditions.difference_threshold
/// and share_above_threshold, of pixels where any channel does. All in [0, 1] (unit "1") but the bias.
std::vector<Measurement> difference_gamma(const SceneImage& test, const SceneImage& reference,
                                          const ComparisonConditions& conditions);
std::vector<Measurement> difference_gamma(const DisplayImage& test, const DisplayImage& reference,
                                          const ComparisonConditions& conditions);

}  // namespace plenolab
