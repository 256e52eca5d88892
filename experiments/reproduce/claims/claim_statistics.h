#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "analysis/statistics.h"

namespace plenolab {

/// Fewer blocks of values than this make a percentile bootstrap too narrow (of three values it gives no more
/// than their range, which holds their mean in three quarters of cases): intervals are then those of
/// Student's t with the delete-one jackknife's standard error (Tukey 1958), which for a mean is the textbook
/// interval.
inline constexpr std::size_t kFewestForBootstrap = 8;

/// What an interval of mean_interval or bootstrap_units rests on: "95 % bootstrap over 24 views", "95 %
/// Student interval over 3 lines of motion".
std::string uncertainty_over(std::size_t values, std::string_view units, int block_length = 1);

/// Mean with its 95 % interval (kFewestForBootstrap). Empty for fewer than two blocks of values: no
/// measurement, or one whose spread is unknown, must not decide a claim. `block_length`: see
/// BootstrapOptions; more than 1 where neighbouring values come from the same object.
std::optional<Interval> mean_interval(std::span<const double> values, std::uint64_t seed,
                                      int block_length = 1);

/// 95 % interval over units 0 … units − 1, for statistics that are no function of single values (ratios of
/// sums). `statistic` receives the drawn units; with few of them see kFewestForBootstrap.
Interval bootstrap_units(std::size_t units, const std::function<double(std::span<const double>)>& statistic,
                         std::uint64_t seed, int block_length = 1);

/// 97.5 % point of the normal distribution: intervals of 95 %.
inline constexpr double kNormal95 = 1.959964;
/// 1 − 0.05/8: intervals that all four of four shares lie in with 95 % at least (Bonferroni).
inline constexpr double kNormal95OfFour = 2.497705;

/// Wilson score interval of a share (Wilson 1927): has a width also for 0 of n and n of n. n ≥ 1.
Interval share_interval(std::size_t hits, std::size_t trials, double normal_point = kNormal95);

}  // namespace plenolab
