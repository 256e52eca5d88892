#include "metrics/viewing_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"

namespace plenolab {
namespace {

constexpr double kLargestLuminance = 1e10;

void check_between(const char* what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw InputError(fmt::format("{} is {} but must lie in [{}, {}]", what, value, low, high));
}

Rgb clamp_unit(Rgb c) {
  const auto clamp = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  return {clamp(c.r), clamp(c.g), clamp(c.b)};
}

/// In double: the largest radiances times a scale do not fit a float.
double positive_luminance(Rgb c) {
  const auto term = [](float weight, float v) {
    return v > 0 ? static_cast<double>(weight) * static_cast<double>(v) : 0;
  };
  return term(kLuminanceWeights.r, c.r) + term(kLuminanceWeights.g, c.g) + term(kLuminanceWeights.b, c.b);
}

}  // namespace

void ViewingConditions::validate() const {
  check_between("pixels_per_degree", pixels_per_degree, 1, 1000);
  check_between("distance_m", distance_m, 0.05, 100);
  check_between("display_peak_cd_m2", display_peak_cd_m2, 1e-6, 1e6);
  if (!(display_black_cd_m2 >= 0 && display_black_cd_m2 < display_peak_cd_m2))
    throw InputError(fmt::format("display_black_cd_m2 is {} but must be at least 0 and below the peak of {}",
                                 display_black_cd_m2, display_peak_cd_m2));
}

Plane<float> displayed_luminance(const DisplayImage& image, const ViewingConditions& viewing) {
  viewing.validate();
  const double range = viewing.display_peak_cd_m2 - viewing.display_black_cd_m2;
  Plane<float> result(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb decoded = gamma_decode(clamp_unit(image.pixels()[i]));
    result.pixels()[i] =
        static_cast<float>(viewing.display_black_cd_m2 + range * static_cast<double>(luminance(decoded)));
  }
  return result;
}

Plane<float> scene_luminance(const SceneImage& image, double cd_m2_per_unit) {
  Plane<float> result(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double scaled = cd_m2_per_unit * positive_luminance(image.pixels()[i]);
    result.pixels()[i] = static_cast<float>(std::min(scaled, kLargestLuminance));
  }
  return result;
}

Plane<float> relative_luminance(const SceneImage& image) {
  double largest = 0;
  for (const Rgb c : image.pixels())
    if (const double l = positive_luminance(c); std::isfinite(l)) largest = std::max(largest, l);
  return scene_luminance(image, largest > 0 ? 1 / largest : 1);
}

}  // namespace plenolab
