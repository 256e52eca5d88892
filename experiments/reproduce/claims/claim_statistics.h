#pragma once

#include <functional>
#include <optional>
#include <span>

#include "analysis/statistics.h"

namespace plenolab {

/// Mean with its 95 % bootstrap interval. Empty for fewer than two values: no measurement, or one whose
/// spread is unknown, must not decide a claim. `block_length`: see BootstrapOptions; more than 1 where
/// neighbouring values come from the same object.
std::optional<Interval> mean_interval(std::span<const double> values, std::uint64_t seed,
                                      int block_length = 1);

/// 95 % percentile bootstrap over units 0 … units − 1, for statistics that are no function of single values
/// (ratios of sums). `statistic` receives the drawn units.
Interval bootstrap_units(std::size_t units, const std::function<double(std::span<const double>)>& statistic,
                         std::uint64_t seed, int block_length = 1);

}  // namespace plenolab
