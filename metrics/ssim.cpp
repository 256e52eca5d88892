#include "metrics/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // (K·L)² with L = 1

/// Gaussian of `taps` taps about their middle, normalised to 1.
std::vector<double> gaussian(int taps) {
  std::vector<double> kernel(static_cast<std::size_t>(taps));
  double sum = 0;
  for (int i = 0; i < taps; ++i) {
    const double distance = i - 0.5 * (taps - 1);
    sum += kernel[static_cast<std::size_t>(i)] = std::exp(-0.5 * distance * distance / (kSigma * kSigma));
  }
  for (double& k : kernel) k /= sum;
  return kernel;
}

/// Weighted sums over a window: of both lumas, their squares and their product.
struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  void add(double weight, const Moments& m) {
    a += weight * m.a, b += weight * m.b, aa += weight * m.aa, bb += weight * m.bb, ab += weight * m.ab;
  }
};

Moments pixel_moments(Rgb test, Rgb reference) {
  const double a = static_cast<double>(luminance(test)), b = static_cast<double>(luminance(reference));
  return {a, b, a * a, b * b, a * b};
}

/// Equation 13. Rounding may leave tiny negative variances, which the constants absorb.
float similarity(const Moments& m) {
  const double ab = m.a * m.b, aa = m.a * m.a, bb = m.b * m.b;
  const double value =
      (2 * ab + kC1) * (2 * (m.ab - ab) + kC2) / ((aa + bb + kC1) * (m.aa - aa + m.bb - bb + kC2));
  return static_cast<float>(std::clamp(value, -1.0, 1.0));
}

/// The rows of the images filtered horizontally.
Plane<Moments> filter_rows(const DisplayImage& test, const DisplayImage& reference,
                           const std::vector<double>& kernel, int threads) {
  const int taps = static_cast<int>(kernel.size());
  Plane<Moments> filtered(test.width() - taps + 1, test.height());
  parallel_for(test.height(), 8, threads, [&](int begin, int end) {
    std::vector<Moments> row(static_cast<std::size_t>(test.width()));
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < test.width(); ++x) {
        row[static_cast<std::size_t>(x)] = pixel_moments(test.at(x, y), reference.at(x, y));
      }
      for (int x = 0; x < filtered.width(); ++x) {
        Moments& sum = filtered.at(x, y);
        for (int i = 0; i < taps; ++i) {
          sum.add(kernel[static_cast<std::size_t>(i)], row[static_cast<std::size_t>(x + i)]);
        }
      }
    }
  });
  return filtered;
}

Plane<float> similarity_map(const DisplayImage& test, const DisplayImage& reference, int threads) {
  const Plane<Moments> rows =
      filter_rows(test, reference, gaussian(std::min(kWindow, test.width())), threads);
  const std::vector<double> kernel = gaussian(std::min(kWindow, test.height()));
  const int taps = static_cast<int>(kernel.size());
  Plane<float> map(rows.width(), rows.height() - taps + 1);
  parallel_for(map.height(), 8, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < map.width(); ++x) {
        Moments sum;
        for (int i = 0; i < taps; ++i) sum.add(kernel[static_cast<std::size_t>(i)], rows.at(x, y + i));
        map.at(x, y) = similarity(sum);
      }
    }
  });
  return map;
}

/// Number of invalid pixels above and to the left of each corner, for counting them in any window at once.
Plane<int> invalid_sums(const Mask& valid) {
  Plane<int> sums(valid.width() + 1, valid.height() + 1, 0);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      sums.at(x + 1, y + 1) =
          sums.at(x, y + 1) + sums.at(x + 1, y) - sums.at(x, y) + (valid.at(x, y) == 0 ? 1 : 0);
    }
  }
  return sums;
}

double mean_of_all(const Plane<float>& map) {
  double sum = 0;
  for (const float v : map.pixels()) sum += static_cast<double>(v);
  return sum / static_cast<double>(map.size());
}

double mean_of_valid_windows(const Plane<float>& map, const Mask& valid) {
  const int taps_x = valid.width() - map.width() + 1, taps_y = valid.height() - map.height() + 1;
  const Plane<int> sums = invalid_sums(valid);
  double sum = 0;
  long long count = 0;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const int invalid =
          sums.at(x + taps_x, y + taps_y) - sums.at(x, y + taps_y) - sums.at(x + taps_x, y) + sums.at(x, y);
      if (invalid > 0) continue;
      sum += static_cast<double>(map.at(x, y));
      ++count;
    }
  }
  if (count == 0) {
    throw InputError(
        "the mask leaves no window of 11×11 valid pixels for SSIM; use a mask with larger valid areas");
  }
  return sum / static_cast<double>(count);
}

std::vector<Measurement> mean_similarity(const Plane<float>& map, const Mask* valid) {
  return {{"ssim_gamma", valid == nullptr ? mean_of_all(map) : mean_of_valid_windows(map, *valid), "1"}};
}

/// Invalid pixels may hold anything, NaN included: they take the reference's place as black in both.
DisplayImage without_invalid(DisplayImage image, const Mask* valid) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!is_valid(valid, i)) image.pixels()[i] = {};
  }
  return image;
}

}  // namespace

Plane<float> ssim_map(const DisplayImage& test, const DisplayImage& reference,
                      const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  if (conditions.valid == nullptr) return similarity_map(test, reference, conditions.threads);
  return similarity_map(without_invalid(test, conditions.valid), without_invalid(reference, conditions.valid),
                        conditions.threads);
}

Plane<float> ssim_map(const SceneImage& test, const SceneImage& reference,
                      const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  return ssim_map(expose(test, conditions.exposure), expose(reference, conditions.exposure), conditions);
}

std::vector<Measurement> ssim_gamma(const SceneImage& test, const SceneImage& reference,
                                    const ComparisonConditions& conditions) {
  return mean_similarity(ssim_map(test, reference, conditions), conditions.valid);
}

std::vector<Measurement> ssim_gamma(const DisplayImage& test, const DisplayImage& reference,
                                    const ComparisonConditions& conditions) {
  return mean_similarity(ssim_map(test, reference, conditions), conditions.valid);
}

}  // namespace plenolab
