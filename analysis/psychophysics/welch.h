#pragma once

#include <cstdint>
#include <span>

#include "analysis/statistics.h"

namespace plenolab {

/// Comparison of two means.

struct SampleSummary {
  double mean = 0, sd = 0;  ///< sample standard deviation (n − 1), ≥ 0
  std::int64_t n = 0;       ///< ≥ 2

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// Throws InputError for fewer than two values or one that is not finite.
SampleSummary summarise(std::span<const double> values);

struct WelchTest {
  Interval difference;  ///< of the means, first − second
  double t = 0;
  double degrees_of_freedom = 0;
  double p_two_sided = 1;  ///< 0 where it underflows
  double log10_p = 0;      ///< of the same, without underflow: never infinite for t that is finite
};

/// Welch's t test (Welch 1947), two-sided, from summaries as papers print them. Values must be independent:
/// for frames in sequence see block_bootstrap_difference. Throws InputError if both standard deviations are
/// 0.
WelchTest welch_test(const SampleSummary& first, const SampleSummary& second, double confidence = 0.95);

/// log10 of the two-sided p value of Student's t.
double log10_student_p(double t, double degrees_of_freedom);

/// Difference of two means with a percentile interval from circular block bootstrap of both, for values in
/// sequence (run times of frames), which are correlated. Uses options.block_length for both.
Interval block_bootstrap_difference(std::span<const double> first, std::span<const double> second,
                                    const BootstrapOptions& options = {});

/// A length of blocks that holds the correlation of values in sequence: twice the first lag at which the
/// autocorrelation lies within ±2/√n, at least 1 and at most a tenth of the values.
int block_length_for(std::span<const double> values);

}  // namespace plenolab
