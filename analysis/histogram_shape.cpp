#include "analysis/histogram_shape.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/base/quantile.h"

namespace plenolab {

namespace {

constexpr double kSmoothing_bins = 4;
constexpr int kFullest = (HistogramShape::kBins + 5) / 10;

std::vector<double> logs_of(const Plane<float>& luminance) {
  std::vector<double> logs;
  for (const float l : luminance.pixels())
    if (l > 0 && std::isfinite(l)) logs.push_back(std::log10(static_cast<double>(l)));
  std::sort(logs.begin(), logs.end());
  return logs;
}

std::vector<double> shares_of(const std::vector<double>& logs, double low, double high) {
  std::vector<double> shares(HistogramShape::kBins);
  const double per_bin = std::max(high - low, 1e-6) / HistogramShape::kBins;
  double inside = 0;
  for (const double v : logs) {
    if (v < low || v > high) continue;
    const auto bin = static_cast<std::size_t>((v - low) / per_bin);
    shares[std::min(bin, shares.size() - 1)] += 1;
    inside += 1;
  }
  if (inside == 0) {  // percentiles between a few far values: each end has its half
    shares.front() = shares.back() = 1;
    inside = 2;
  }
  for (double& share : shares) share /= inside;
  return shares;
}

double concentration_of(std::vector<double> shares) {
  std::partial_sort(shares.begin(), shares.begin() + kFullest, shares.end(), std::greater<>());
  return std::accumulate(shares.begin(), shares.begin() + kFullest, 0.0);
}

/// Half the sum of differences from the smoothed histogram, which keeps the sum.
double jaggedness_of(const std::vector<double>& shares) {
  constexpr int kReach = static_cast<int>(4 * kSmoothing_bins), kBins = HistogramShape::kBins;
  std::vector<double> weights(2 * kReach + 1);
  for (int k = -kReach; k <= kReach; ++k)
    weights[static_cast<std::size_t>(k + kReach)] = std::exp(-0.5 * std::pow(k / kSmoothing_bins, 2));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  double moved = 0;
  for (int i = 0; i < kBins; ++i) {
    double smooth = 0;
    for (int k = -kReach; k <= kReach; ++k) {
      int j = i + k;
      if (j < 0) j = -1 - j;
      if (j >= kBins) j = 2 * kBins - 1 - j;
      smooth += weights[static_cast<std::size_t>(k + kReach)] * shares[static_cast<std::size_t>(j)];
    }
    moved += std::abs(shares[static_cast<std::size_t>(i)] - smooth / sum);
  }
  return moved / 2;
}

}  // namespace

std::optional<HistogramShape> histogram_shape(const Plane<float>& luminance) {
  const std::vector<double> logs = logs_of(luminance);
  if (logs.empty()) return {};
  HistogramShape shape;
  shape.log10_low = quantile_of_sorted<double>(logs, 0.005);
  shape.log10_high = quantile_of_sorted<double>(logs, 0.995);
  shape.shares = shares_of(logs, shape.log10_low, shape.log10_high);
  shape.concentration = concentration_of(shape.shares);
  shape.jaggedness = jaggedness_of(shape.shares);
  return shape;
}

}  // namespace plenolab
