#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace plenolab {

/// An estimate with a confidence interval [low, high].
struct Interval {
  double estimate = 0, low = 0, high = 0;
};

double mean(std::span<const double> values);
/// Quantile p in [0, 1], linear between order statistics (type 7 of Hyndman & Fan 1996, R's default).
double quantile(std::span<const double> values, double p);
double median(std::span<const double> values);

/// How intervals are bootstrapped.
struct BootstrapOptions {
  double confidence = 0.95;  ///< in (0, 1)
  int resamples = 2000;      ///< ≥ 100
  std::uint64_t seed = 1;
  /// Length of the blocks that are drawn together, ≥ 1: more than the correlation length for values in
  /// sequence (frames of a video), where drawing single values would give intervals that are too short.
  /// Circular.
  int block_length = 1;

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// Percentile bootstrap interval (Efron & Tibshirani 1993, section 13.3) of any statistic; blocks as in the
/// circular block bootstrap (Politis & Romano 1992). Every random choice is a hash of the seed. One value
/// alone gives an interval of no width: callers must not read certainty into it. Throws InputError for no
/// values or a value that is not finite.
Interval bootstrap_interval(std::span<const double> values,
                            const std::function<double(std::span<const double>)>& statistic,
                            const BootstrapOptions& options = {});

}  // namespace plenolab
