#include "analysis/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

constexpr std::uint64_t kBootstrapPurpose =
    0x626f6f7473747270;  // keeps its random words apart from other uses

void check_values(std::span<const double> values) {
  if (values.empty()) throw InputError("a statistic needs at least one value");
  const auto bad = std::count_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (bad > 0) throw InputError(fmt::format("{} of {} values are not finite", bad, values.size()));
}

/// Fills `sample` with blocks drawn from `values` as if they were arranged in a circle.
void draw_sample(std::span<const double> values, int block_length, RandomStream& random,
                 std::vector<double>& sample) {
  const std::size_t n = values.size();
  for (std::size_t filled = 0; filled < n;) {
    const std::size_t start = static_cast<std::size_t>(random.next_double() * static_cast<double>(n));
    for (int k = 0; k < block_length && filled < n; ++k) {
      sample[filled++] = values[(start + static_cast<std::size_t>(k)) % n];
    }
  }
}

}  // namespace

double mean(std::span<const double> values) {
  check_values(values);
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double quantile(std::span<const double> values, double p) {
  check_values(values);
  if (!(p >= 0 && p <= 1)) throw InputError(fmt::format("quantile {} does not lie in [0, 1]", p));
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return quantile_of_sorted(std::span<const double>(sorted), p);
}

double median(std::span<const double> values) {
  return quantile(values, 0.5);
}

void BootstrapOptions::validate() const {
  if (!(confidence > 0 && confidence < 1)) {
    throw InputError(fmt::format("bootstrap confidence is {} but must lie in (0, 1)", confidence));
  }
  if (resamples < 100)
    throw InputError(fmt::format("bootstrap resamples are {} but must be at least 100", resamples));
  if (block_length < 1)
    throw InputError(fmt::format("bootstrap block_length is {} but must be ≥ 1", block_length));
}

Interval bootstrap_interval(std::span<const double> values,
                            const std::function<double(std::span<const double>)>& statistic,
                            const BootstrapOptions& options) {
  options.validate();
  check_values(values);
  std::vector<double> sample(values.size());
  std::vector<double> estimates(static_cast<std::size_t>(options.resamples));
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    RandomStream random(options.seed, kBootstrapPurpose, i);
    draw_sample(values, options.block_length, random, sample);
    estimates[i] = statistic(sample);
  }
  std::sort(estimates.begin(), estimates.end());
  const std::span<const double> sorted = estimates;
  const double tail = (1 - options.confidence) / 2;
  return {statistic(values), quantile_of_sorted(sorted, tail), quantile_of_sorted(sorted, 1 - tail)};
}

}  // namespace plenolab
