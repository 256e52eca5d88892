#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/image/colour.h"
#include "core/image/image.h"
#include "stimuli/scene.h"

namespace plenolab::tracer {

inline constexpr float kPi = std::numbers::pi_v<float>;

inline float max_component(Rgb c) {
  return std::max({c.r, c.g, c.b});
}
inline bool is_black(Rgb c) {
  return c.r == 0 && c.g == 0 && c.b == 0;
}
inline float square(float x) {
  return x * x;
}

/// Beer-Lambert transmittance of a homogeneous absorber; exactly 1 where nothing is absorbed, over any
/// length.
inline Rgb transmittance(Rgb absorption_per_m, float length_m) {
  const auto along = [&](float a) { return a > 0 ? std::exp(-a * length_m) : 1.0f; };
  return {along(absorption_per_m.r), along(absorption_per_m.g), along(absorption_per_m.b)};
}

/// Orthonormal basis about a unit normal (Duff et al. 2017, "Building an orthonormal basis, revisited").
struct Frame {
  Vec3 x, y, z;

  explicit Frame(const Vec3& normal) : z(normal) {
    const float sign = std::copysign(1.0f, normal.z());
    const float a = -1.0f / (sign + normal.z());
    const float b = normal.x() * normal.y() * a;
    x = Vec3(1.0f + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
    y = Vec3(b, sign + normal.y() * normal.y() * a, -normal.y());
  }
  Vec3 to_world(const Vec3& v) const { return v.x() * x + v.y() * y + v.z() * z; }
  Vec3 to_local(const Vec3& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
};

/// Mirror image of `direction` (pointing away from the surface) about a unit normal.
inline Vec3 reflected(const Vec3& direction, const Vec3& normal) {
  return 2.0f * direction.dot(normal) * normal - direction;
}

/// Weight of a sample drawn with density `own` when another strategy draws with density `other` (Veach 1997,
/// power heuristic, β = 2). 0 for own = 0.
inline float power_heuristic(float own, float other) {
  if (!(own > 0)) return 0;
  const float ratio = other / own;
  return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace plenolab::tracer
