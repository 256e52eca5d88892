#include "metrics/difference.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/image/colour.h"

namespace plenolab {
namespace {

/// Differences of one channel over the valid pixels, in pixel order.
std::vector<double> channel_differences(const DisplayImage& test, const DisplayImage& reference,
                                        const Mask* valid, float Rgb::*channel) {
  std::vector<double> differences;
  differences.reserve(test.size());
  for (std::size_t i = 0; i < test.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    differences.push_back(static_cast<double>(test.pixels()[i].*channel) -
                          static_cast<double>(reference.pixels()[i].*channel));
  }
  return differences;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double share_above(const std::vector<double>& values, double threshold) {
  const auto above = std::count_if(values.begin(), values.end(), [&](double v) { return v > threshold; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

void add_channel_statistics(const std::vector<double>& differences, const std::string& channel,
                            double threshold, std::vector<Measurement>& rows) {
  std::vector<double> magnitudes(differences.size());
  std::transform(differences.begin(), differences.end(), magnitudes.begin(),
                 [](double v) { return std::abs(v); });
  std::sort(magnitudes.begin(), magnitudes.end());
  const std::span<const double> sorted = magnitudes;
  const auto add = [&](const char* name, double value) {
    rows.push_back({name + ("_" + channel), value, "1"});
  };
  add("mean_difference", mean_of(differences));
  add("mean_abs_difference", mean_of(magnitudes));
  add("rms_difference", root_mean_square(differences));
  add("max_abs_difference", sorted.back());
  add("abs_difference_p50", quantile_of_sorted(sorted, 0.50));
  add("abs_difference_p95", quantile_of_sorted(sorted, 0.95));
  add("abs_difference_p99", quantile_of_sorted(sorted, 0.99));
  add("share_above_threshold", share_above(magnitudes, threshold));
}

/// Largest absolute difference of the three channels, of valid pixels.
std::vector<double> largest_differences(const DisplayImage& test, const DisplayImage& reference,
                                        const Mask* valid) {
  std::vector<double> largest;
  for (std::size_t i = 0; i < test.size(); ++i) {
    const Rgb a = test.pixels()[i], b = reference.pixels()[i];
    if (!is_valid(valid, i)) continue;
    const auto distance = [](float p, float q) {
      return std::abs(static_cast<double>(p) - static_cast<double>(q));
    };
    largest.push_back(std::max({distance(a.r, b.r), distance(a.g, b.g), distance(a.b, b.b)}));
  }
  return largest;
}

}  // namespace

std::vector<Measurement> difference_gamma(const DisplayImage& test, const DisplayImage& reference,
                                          const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  const Mask* valid = conditions.valid;
  const double threshold = conditions.difference_threshold;
  std::vector<Measurement> rows;
  add_channel_statistics(channel_differences(test, reference, valid, &Rgb::r), "r", threshold, rows);
  add_channel_statistics(channel_differences(test, reference, valid, &Rgb::g), "g", threshold, rows);
  add_channel_statistics(channel_differences(test, reference, valid, &Rgb::b), "b", threshold, rows);
  rows.push_back(
      {"share_above_threshold", share_above(largest_differences(test, reference, valid), threshold), "1"});
  return rows;
}

std::vector<Measurement> difference_gamma(const SceneImage& test, const SceneImage& reference,
                                          const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  return difference_gamma(expose(test, conditions.exposure), expose(reference, conditions.exposure),
                          conditions);
}

}  // namespace plenolab
