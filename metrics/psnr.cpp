#include "metrics/psnr.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {
namespace {

/// Mean over the valid pixels of value(index), summed row by row so that it does not depend on the threads.
template <class Value>
double mean_over_valid(const Plane<Rgb>& image, const ComparisonConditions& conditions, const Value& value) {
  const int width = image.width();
  std::vector<double> row_sums(static_cast<std::size_t>(image.height()));
  std::vector<std::size_t> row_counts(row_sums.size());
  parallel_for(image.height(), 16, conditions.threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::size_t row = static_cast<std::size_t>(y), first = row * static_cast<std::size_t>(width);
      for (std::size_t i = first; i < first + static_cast<std::size_t>(width); ++i) {
        if (!is_valid(conditions.valid, i)) continue;
        row_sums[row] += value(i);
        ++row_counts[row];
      }
    }
  });
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t row = 0; row < row_sums.size(); ++row) {
    sum += row_sums[row];
    count += row_counts[row];
  }
  return sum / static_cast<double>(count);
}

double squared_difference(Rgb a, Rgb b) {
  const double r = static_cast<double>(a.r) - static_cast<double>(b.r);
  const double g = static_cast<double>(a.g) - static_cast<double>(b.g);
  const double blue = static_cast<double>(a.b) - static_cast<double>(b.b);
  return (r * r + g * g + blue * blue) / 3;
}

double mean_squared_error(const Plane<Rgb>& test, const Plane<Rgb>& reference,
                          const ComparisonConditions& conditions) {
  return mean_over_valid(reference, conditions, [&](std::size_t i) {
    return squared_difference(test.pixels()[i], reference.pixels()[i]);
  });
}

double largest_channel(const SceneImage& image, const Mask* valid) {
  float largest = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb c = image.pixels()[i];
    if (is_valid(valid, i)) largest = std::max({largest, c.r, c.g, c.b});
  }
  return static_cast<double>(largest);
}

bool is_clipped(float value) {
  return value < 0 || value > 1;
}

}  // namespace

double psnr_db(double peak, double mean_squared_error) {
  if (mean_squared_error == 0) return std::numeric_limits<double>::infinity();
  return 20 * std::log10(peak) - 10 * std::log10(mean_squared_error);
}

std::vector<Measurement> psnr_linear(const SceneImage& test, const SceneImage& reference,
                                     const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  const double peak = largest_channel(reference, conditions.valid);
  return {{"psnr_linear_db", psnr_db(peak, mean_squared_error(test, reference, conditions)), "dB"},
          {"psnr_linear_peak", peak, "image unit"}};
}

std::vector<Measurement> psnr_gamma(const SceneImage& test, const SceneImage& reference,
                                    const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  const double error = mean_squared_error(expose(test, conditions.exposure),
                                          expose(reference, conditions.exposure), conditions);
  const double clipped = mean_over_valid(reference, conditions, [&](std::size_t i) {
    const Rgb c = reference.pixels()[i] * conditions.exposure;
    return is_clipped(c.r) || is_clipped(c.g) || is_clipped(c.b) ? 1.0 : 0.0;
  });
  return {{"psnr_gamma_db", psnr_db(1, error), "dB"}, {"gamma_clipped_share", clipped, "1"}};
}

std::vector<Measurement> psnr_gamma(const DisplayImage& test, const DisplayImage& reference,
                                    const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  return {{"psnr_gamma_db", psnr_db(1, mean_squared_error(test, reference, conditions)), "dB"},
          {"gamma_clipped_share", 0, "1"}};
}

std::vector<Measurement> psnr_pq(const SceneImage& test, const SceneImage& reference,
                                 const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  const auto cd_m2 = [&](Rgb c) { return static_cast<double>(luminance(c)) * conditions.cd_m2_per_unit; };
  const double error = mean_over_valid(reference, conditions, [&](std::size_t i) {
    const double difference = pq_encode(cd_m2(test.pixels()[i])) - pq_encode(cd_m2(reference.pixels()[i]));
    return difference * difference;
  });
  const double clipped = mean_over_valid(reference, conditions, [&](std::size_t i) {
    const double value = cd_m2(reference.pixels()[i]);
    return value < 0 || value > 10000 ? 1.0 : 0.0;
  });
  return {{"psnr_pq_db", psnr_db(1, error), "dB"}, {"pq_clipped_share", clipped, "1"}};
}

}  // namespace plenolab
