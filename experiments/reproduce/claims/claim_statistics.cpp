#include "experiments/reproduce/claims/claim_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/error.h"

namespace plenolab {

namespace {

std::size_t count_blocks(std::size_t values, int block_length) {
  const auto length = static_cast<std::size_t>(block_length);
  return (values + length - 1) / length;
}

/// 97.5 % point of Student's t.
double student_95(std::size_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degrees)), 0.975);
}

/// The statistic without each block in turn; its scatter gives the standard error.
Interval jackknife_interval(std::span<const double> values,
                            const std::function<double(std::span<const double>)>& statistic,
                            int block_length) {
  const auto length = static_cast<std::size_t>(block_length);
  const std::size_t blocks = count_blocks(values.size(), block_length);
  std::vector<double> without;
  for (std::size_t block = 0; block < blocks; ++block) {
    std::vector<double> rest;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (i / length != block) rest.push_back(values[i]);
    without.push_back(statistic(rest));
  }
  const double estimate = statistic(values);
  // A ratio may lose its whole denominator with one block: then these values bound nothing.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!std::ranges::all_of(without, [](double value) { return std::isfinite(value); }))
    return {estimate, -kInfinity, kInfinity};
  const double centre = mean(without);
  double squares = 0;
  for (const double value : without) squares += (value - centre) * (value - centre);
  const auto n = static_cast<double>(blocks);
  const double half = student_95(blocks - 1) * std::sqrt((n - 1) / n * squares);
  return {estimate, estimate - half, estimate + half};
}

Interval interval_of(std::span<const double> values,
                     const std::function<double(std::span<const double>)>& statistic, std::uint64_t seed,
                     int block_length) {
  const std::size_t blocks = count_blocks(values.size(), block_length);
  if (blocks >= 2 && blocks < kFewestForBootstrap) return jackknife_interval(values, statistic, block_length);
  return bootstrap_interval(values, statistic, {.seed = seed, .block_length = block_length});
}

}  // namespace

std::string uncertainty_over(std::size_t values, std::string_view units, int block_length) {
  const bool few = count_blocks(values, block_length) < kFewestForBootstrap;
  return fmt::format("95 % {} over {} {}{}", few ? "Student interval" : "bootstrap", values, units,
                     block_length > 1 ? fmt::format(", {} together", block_length) : "");
}

std::optional<Interval> mean_interval(std::span<const double> values, std::uint64_t seed, int block_length) {
  if (count_blocks(values.size(), block_length) < 2) return std::nullopt;
  return interval_of(values, mean, seed, block_length);
}

Interval bootstrap_units(std::size_t units, const std::function<double(std::span<const double>)>& statistic,
                         std::uint64_t seed, int block_length) {
  std::vector<double> indices(units);
  std::iota(indices.begin(), indices.end(), 0.0);
  return interval_of(indices, statistic, seed, block_length);
}

Interval share_interval(std::size_t hits, std::size_t trials, double z) {
  PLENOLAB_CHECK(trials > 0 && hits <= trials, fmt::format("{} of {}", hits, trials));
  const double n = static_cast<double>(trials), p = static_cast<double>(hits) / n;
  const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  // The ends at 0 and n hits are exactly 0 and 1; rounding must not leave the estimate outside.
  return {p, hits == 0 ? 0 : centre - half, hits == trials ? 1 : centre + half};
}

}  // namespace plenolab
