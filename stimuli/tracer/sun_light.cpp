#include "stimuli/tracer/sun_light.h"

namespace plenolab::tracer {

SunLight::SunLight(const Scene& scene) {
  const Sun sun = scene.sun.value_or(Sun{.illuminance_lx = {0, 0, 0}});
  const double half_angle = sun.angular_diameter_deg * std::numbers::pi / 360.0;
  const double sine = std::sin(half_angle);
  direction_ = sun.direction;
  // A disc of radiance L subtending the half angle θ gives π·sin²θ·L on a surface that faces it.
  radiance_ = sun.illuminance_lx * static_cast<float>(1.0 / (std::numbers::pi * sine * sine));
  const double one_minus_cos = 2.0 * std::sin(half_angle / 2) * std::sin(half_angle / 2);
  one_minus_cos_ = static_cast<float>(one_minus_cos);
  pdf_ = static_cast<float>(1.0 / (2.0 * std::numbers::pi * one_minus_cos));
}

Rgb SunLight::radiance(const Vec3& direction) const {
  // |a − b|² = 2(1 − a·b) keeps the digits that 1 − a·b loses near a = b.
  return (direction - direction_).squaredNorm() <= 2.0f * one_minus_cos_ ? radiance_ : Rgb{};
}

Vec3 SunLight::sample(std::array<float, 2> u) const {
  const float below_one = u[0] * one_minus_cos_;
  const float sine = std::sqrt(below_one * (2.0f - below_one)), phi = 2.0f * kPi * u[1];
  return Frame(direction_)
      .to_world({sine * std::cos(phi), sine * std::sin(phi), 1.0f - below_one})
      .normalized();
}

}  // namespace plenolab::tracer
