#include "analysis/psychophysics/rank_correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr std::size_t kFewest = 4, kMost = 9;

/// Ranks from 1; equal values share the mean of theirs.
std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<double> ranks;
  for (const double v : values) {
    const auto below = std::count_if(values.begin(), values.end(), [&](double w) { return w < v; });
    const auto equal = std::count(values.begin(), values.end(), v);
    ranks.push_back(static_cast<double>(below) + 0.5 * static_cast<double>(equal + 1));
  }
  return ranks;
}

/// Pearson's correlation of ranks, 0 where one side has no spread.
double correlation(std::span<const double> a, std::span<const double> b) {
  const double centre = 0.5 * static_cast<double>(a.size() + 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - centre) * (b[i] - centre);
    aa += (a[i] - centre) * (a[i] - centre);
    bb += (b[i] - centre) * (b[i] - centre);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

Interval fisher_interval(double rho, std::size_t n, double confidence) {
  const double z = std::atanh(std::clamp(rho, -1.0, 1.0));
  if (!std::isfinite(z)) return {rho, rho > 0 ? -1.0 : rho, rho > 0 ? rho : 1.0};  // says nothing
  const double error = std::sqrt((1 + rho * rho / 2) / static_cast<double>(n - 3));
  const double half = error * quantile(boost::math::normal(), 0.5 + confidence / 2);
  return {rho, std::tanh(z - half), std::tanh(z + half)};
}

void check(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size() || x.size() < kFewest || x.size() > kMost)
    throw InputError(fmt::format("a rank correlation needs {} to {} pairs, not {} and {} numbers", kFewest,
                                 kMost, x.size(), y.size()));
  for (const auto& side : {x, y}) {
    const auto [low, high] = std::minmax_element(side.begin(), side.end());
    if (!std::all_of(side.begin(), side.end(), [](double v) { return std::isfinite(v); }) || *low == *high)
      throw InputError("a rank correlation needs finite numbers that are not all equal");
  }
}

}  // namespace

RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y, double confidence) {
  check(x, y);
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double rho = correlation(a, b);
  std::vector<std::size_t> order(a.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::vector<double> all, permuted(b.size());
  do {
    for (std::size_t i = 0; i < order.size(); ++i) permuted[i] = b[order[i]];
    all.push_back(std::abs(correlation(a, permuted)));
  } while (std::next_permutation(order.begin(), order.end()));
  const auto share_from = [&](double limit) {
    const auto count = std::count_if(all.begin(), all.end(), [&](double r) { return r >= limit - 1e-12; });
    return static_cast<double>(count) / static_cast<double>(all.size());
  };
  return {fisher_interval(rho, a.size(), confidence), share_from(std::abs(rho)),
          share_from(*std::max_element(all.begin(), all.end()))};
}

}  // namespace plenolab
