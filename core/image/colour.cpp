#include "core/image/colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plenolab {

namespace {
// SMPTE ST 2084:2014, section 5.2.
constexpr double kM1 = 2610.0 / 16384.0;
constexpr double kM2 = 2523.0 / 4096.0 * 128.0;
constexpr double kC1 = 3424.0 / 4096.0;
constexpr double kC2 = 2413.0 / 4096.0 * 32.0;
constexpr double kC3 = 2392.0 / 4096.0 * 32.0;
constexpr double kPeak_cd_m2 = 10000.0;
}  // namespace

float gamma_encode(float linear) {
  return linear > 0 ? std::pow(linear, 1.0f / 2.2f) : 0.0f;
}
float gamma_decode(float encoded) {
  return encoded > 0 ? std::pow(encoded, 2.2f) : 0.0f;
}
Rgb gamma_encode(Rgb c) {
  return {gamma_encode(c.r), gamma_encode(c.g), gamma_encode(c.b)};
}
Rgb gamma_decode(Rgb c) {
  return {gamma_decode(c.r), gamma_decode(c.g), gamma_decode(c.b)};
}

double pq_encode(double luminance_cd_m2) {
  const double y = std::pow(std::clamp(luminance_cd_m2 / kPeak_cd_m2, 0.0, 1.0), kM1);
  return std::pow((kC1 + kC2 * y) / (1.0 + kC3 * y), kM2);
}

double pq_decode(double signal) {
  const double e = std::pow(std::clamp(signal, 0.0, 1.0), 1.0 / kM2);
  return kPeak_cd_m2 * std::pow(std::max(e - kC1, 0.0) / (kC2 - kC3 * e), 1.0 / kM1);
}

DisplayImage expose(const SceneImage& scene, float exposure) {
  DisplayImage out(scene.width(), scene.height());
  const auto encode = [exposure](float v) { return std::min(1.0f, gamma_encode(exposure * v)); };
  std::transform(scene.pixels().begin(), scene.pixels().end(), out.pixels().begin(), [&](Rgb c) {
    return Rgb{encode(c.r), encode(c.g), encode(c.b)};
  });
  return out;
}

float exposure_from(const SceneImage& truth) {
  std::vector<float> values;
  values.reserve(truth.size());
  for (const Rgb& c : truth.pixels()) {
    const float y = luminance(c);
    if (std::isfinite(y) && y > 0) values.push_back(y);
  }
  if (values.empty()) return 1.0f;
  const auto p99 =
      values.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(values.size() - 1) * 0.99);
  std::nth_element(values.begin(), p99, values.end());
  return std::min(1.0f / *p99, std::numeric_limits<float>::max());  // of denormal radiance
}

}  // namespace plenolab
