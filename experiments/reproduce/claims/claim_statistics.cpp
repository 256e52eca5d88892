#include "experiments/reproduce/claims/claim_statistics.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "core/base/error.h"

namespace plenolab {

std::optional<Interval> mean_interval(std::span<const double> values, std::uint64_t seed, int block_length) {
  if (values.size() < 2) return std::nullopt;
  return bootstrap_interval(values, mean, {.seed = seed, .block_length = block_length});
}

Interval bootstrap_units(std::size_t units, const std::function<double(std::span<const double>)>& statistic,
                         std::uint64_t seed, int block_length) {
  std::vector<double> indices(units);
  std::iota(indices.begin(), indices.end(), 0.0);
  return bootstrap_interval(indices, statistic, {.seed = seed, .block_length = block_length});
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
