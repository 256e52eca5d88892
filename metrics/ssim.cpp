#include "metrics/ssim.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "metrics/window_moments.h"

namespace plenolab {
namespace {

constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // (K·L)² with L = 1

/// Equation 13. Rounding may leave tiny negative variances, which the constants absorb.
float similarity(const WindowMoments& m) {
  const double ab = m.a * m.b, aa = m.a * m.a, bb = m.b * m.b;
  const double value =
      (2 * ab + kC1) * (2 * (m.ab - ab) + kC2) / ((aa + bb + kC1) * (m.aa - aa + m.bb - bb + kC2));
  return static_cast<float>(std::clamp(value, -1.0, 1.0));
}

Plane<double> luma_of(const DisplayImage& image) {
  Plane<double> luma(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i)
    luma.pixels()[i] = static_cast<double>(luminance(image.pixels()[i]));
  return luma;
}

Plane<float> similarity_map(const DisplayImage& test, const DisplayImage& reference, int threads) {
  const WindowGrid grid = windows_of(test.width(), test.height());
  Plane<float> map(grid.width, grid.height);
  visit_windows(luma_of(test), luma_of(reference), threads,
                [&](int x, int y, const WindowMoments& m) { map.at(x, y) = similarity(m); });
  return map;
}

std::vector<Measurement> mean_similarity(const Plane<float>& map, const Mask* valid) {
  constexpr double kNone = -2;
  const double mean = mean_of_windows(map, valid, kNone);
  if (mean == kNone) {
    throw InputError(
        "the mask leaves no window of 11×11 valid pixels for SSIM; use a mask with larger valid areas");
  }
  return {{"ssim_gamma", mean, "1"}};
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
