#pragma once

#include <array>

#include "stimuli/tracer/maths.h"

namespace plenolab::tracer {

/// The sun as a cone of directions with uniform radiance. Without a sun the radiance is 0.
class SunLight {
 public:
  explicit SunLight(const Scene& scene);

  bool shines() const { return !is_black(radiance_); }
  /// Radiance from a direction: that of the disc inside the cone, 0 outside.
  Rgb radiance(const Vec3& direction) const;
  Rgb disc_radiance() const { return radiance_; }
  /// Unit direction towards the middle of the disc.
  const Vec3& centre() const { return direction_; }
  /// Direction inside the cone, uniform per solid angle.
  Vec3 sample(std::array<float, 2> u) const;
  /// Density per solid angle of sample() inside the cone.
  float pdf() const { return pdf_; }

 private:
  Vec3 direction_{0, 0, 1};
  Rgb radiance_{};
  float one_minus_cos_ = 1e-5f;
  float pdf_ = 0;
};

}  // namespace plenolab::tracer
