#include "experiments/reproduce/claims/claim_statistics.h"

#include <numeric>

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

}  // namespace plenolab
