#include "metrics/tmqi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "metrics/window_moments.h"

namespace plenolab {
namespace {

constexpr std::array<double, 5> kWeights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr std::array<double, 5> kFrequenciesCpd{16, 8, 4, 2, 1};
constexpr double kFidelityShare = 0.8012, kFidelityPower = 0.3046, kNaturalnessPower = 0.7088;
constexpr double kC1 = 0.01, kC2 = 10;
constexpr double kHdrPeak = 4294967295.0;

/// Images of one scale; invalid pixels are 0 in both.
struct Scale {
  Plane<double> hdr, mapped;
  std::optional<Mask> valid;
  const Mask* mask() const { return valid ? &*valid : nullptr; }
};

double luminance_of(Rgb c) {
  return 0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) +
         0.0722 * static_cast<double>(c.b);
}

/// Luminance scaled to [0, kHdrPeak]; all 0 where it does not vary.
Plane<double> scaled_luminance(const SceneImage& image, const Mask* valid) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    low = std::min(low, luminance_of(image.pixels()[i]));
    high = std::max(high, luminance_of(image.pixels()[i]));
  }
  Plane<double> scaled(image.width(), image.height());
  if (!(high > low)) return scaled;
  for (std::size_t i = 0; i < image.size(); ++i)
    if (is_valid(valid, i))
      scaled.pixels()[i] = (luminance_of(image.pixels()[i]) - low) / (high - low) * kHdrPeak;
  return scaled;
}

Plane<double> luma_255(const DisplayImage& image, const Mask* valid) {
  Plane<double> luma(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i)
    if (is_valid(valid, i)) luma.pixels()[i] = 255 * luminance_of(image.pixels()[i]);
  return luma;
}

Plane<double> halved(const Plane<double>& image) {
  Plane<double> half(image.width() / 2, image.height() / 2);
  for (int y = 0; y < half.height(); ++y)
    for (int x = 0; x < half.width(); ++x)
      half.at(x, y) = 0.25 * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                              image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1));
  return half;
}

/// Valid where all four pixels are.
Mask halved(const Mask& mask) {
  Mask half(mask.width() / 2, mask.height() / 2);
  for (int y = 0; y < half.height(); ++y)
    for (int x = 0; x < half.width(); ++x)
      half.at(x, y) = mask.at(2 * x, 2 * y) != 0 && mask.at(2 * x + 1, 2 * y) != 0 &&
                      mask.at(2 * x, 2 * y + 1) != 0 && mask.at(2 * x + 1, 2 * y + 1) != 0;
  return half;
}

/// Variance from moments, 0 where it is within their rounding.
double variance(double mean, double mean_of_squares) {
  const double value = mean_of_squares - mean * mean;
  return value > 1e-13 * mean_of_squares ? value : 0;
}

double local_fidelity(const WindowMoments& m, int scale) {
  const double hdr = std::sqrt(variance(m.a, m.aa)), mapped = std::sqrt(variance(m.b, m.bb));
  const double seen_hdr = tmqi_detected_deviation(hdr, scale);
  const double seen_mapped = tmqi_detected_deviation(mapped, scale);
  const double covariance = hdr * mapped > 0 ? m.ab - m.a * m.b : 0;
  const double strength =
      (2 * seen_hdr * seen_mapped + kC1) / (seen_hdr * seen_hdr + seen_mapped * seen_mapped + kC1);
  const double structure = (covariance + kC2) / (hdr * mapped + kC2);
  return std::clamp(strength * structure, -1.0, 1.0);
}

/// Mean over the windows of one scale, not below 0; nothing if the mask leaves no window.
std::optional<double> fidelity_of(const Scale& images, int scale, int threads) {
  const WindowGrid grid = windows_of(images.hdr.width(), images.hdr.height());
  Plane<float> map(grid.width, grid.height);
  visit_windows(images.hdr, images.mapped, threads, [&](int x, int y, const WindowMoments& m) {
    map.at(x, y) = static_cast<float>(local_fidelity(m, scale));
  });
  constexpr double kNone = -2;
  const double mean = mean_of_windows(map, images.mask(), kNone);
  if (mean == kNone) return std::nullopt;
  return std::max(mean, 0.0);
}

/// S over all scales that there are.
double fidelity(Scale images, int threads) {
  double log_sum = 0, weights = 0, all = 0;
  for (const double w : kWeights) all += w;
  for (std::size_t scale = 0; scale < kWeights.size(); ++scale) {
    if (scale > 0) {
      images = {halved(images.hdr), halved(images.mapped),
                images.valid ? std::optional(halved(*images.valid)) : std::nullopt};
      if (std::min(images.hdr.width(), images.hdr.height()) < kStructureWindow) break;
    }
    const std::optional<double> value = fidelity_of(images, static_cast<int>(scale), threads);
    if (!value && scale == 0)
      throw InputError(
          "the mask leaves no window of 11×11 valid pixels for TMQI; use a mask with larger valid areas");
    if (!value) break;
    log_sum += kWeights[scale] * std::log(*value);
    weights += kWeights[scale];
  }
  return std::exp(log_sum * all / weights);
}

/// Deviation (divided by n − 1) of the pixels of a block; nothing if one is invalid or there is only one.
std::optional<double> block_deviation(const Plane<double>& luma, const Mask* valid, int left, int top) {
  const int right = std::min(left + kStructureWindow, luma.width());
  const int bottom = std::min(top + kStructureWindow, luma.height());
  double sum = 0, squares = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      if (valid != nullptr && valid->at(x, y) == 0) return std::nullopt;
      sum += luma.at(x, y);
      squares += luma.at(x, y) * luma.at(x, y);
    }
  }
  const double count = static_cast<double>((right - left) * (bottom - top));
  if (count < 2) return std::nullopt;
  return std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1)));
}

double mean_block_deviation(const Plane<double>& luma, const Mask* valid) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < luma.height(); y += kStructureWindow) {
    for (int x = 0; x < luma.width(); x += kStructureWindow) {
      const std::optional<double> deviation = block_deviation(luma, valid, x, y);
      sum += deviation.value_or(0);
      count += deviation.has_value();
    }
  }
  return count > 0 ? sum / count : 0;
}

double mean_of_valid(const Plane<double>& luma, const Mask* valid) {
  double sum = 0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < luma.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    sum += luma.pixels()[i];
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// Density of the beta distribution over its largest value; 0 outside [0, 1].
double relative_beta(double x, double a, double b) {
  if (!(x > 0 && x < 1)) return 0;
  const double mode = (a - 1) / (a + b - 2);
  return std::pow(x / mode, a - 1) * std::pow((1 - x) / (1 - mode), b - 1);
}

}  // namespace

double tmqi_detected_deviation(double deviation, int scale) {
  const double f = 0.114 * kFrequenciesCpd.at(static_cast<std::size_t>(scale));
  const double sensitivity = 100 * 2.6 * (0.0192 + f) * std::exp(-std::pow(f, 1.1));
  const double threshold = 128 / (1.4 * sensitivity);
  return 0.5 * std::erfc(-(deviation - threshold) / (threshold / 3) / std::sqrt(2.0));
}

double tmqi_naturalness(double mean, double deviation) {
  const double distance = (mean - 115.94) / 27.99;
  return std::exp(-0.5 * distance * distance) * relative_beta(deviation / 64.29, 4.4, 10.1);
}

std::vector<Measurement> tmqi(const DisplayImage& test, const SceneImage& reference,
                              const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  Scale images{scaled_luminance(reference, conditions.valid), luma_255(test, conditions.valid),
               conditions.valid != nullptr ? std::optional(*conditions.valid) : std::nullopt};
  const double naturalness = tmqi_naturalness(mean_of_valid(images.mapped, conditions.valid),
                                              mean_block_deviation(images.mapped, conditions.valid));
  const double structure = fidelity(std::move(images), conditions.threads);
  const double quality = kFidelityShare * std::pow(structure, kFidelityPower) +
                         (1 - kFidelityShare) * std::pow(naturalness, kNaturalnessPower);
  return {{"tmqi", quality, "1"}, {"tmqi_fidelity", structure, "1"}, {"tmqi_naturalness", naturalness, "1"}};
}

}  // namespace plenolab
