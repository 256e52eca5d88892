#pragma once

#include "core/image/image.h"

namespace plenolab::tracer {

/// Daylight of Preetham, Shirley and Smits 1999, "A practical analytic model for daylight", appendix A.2: the
/// zenith values of luminance and chromaticity and the Perez distribution around them.
class PreethamSky {
 public:
  /// `sun_zenith_angle` in radians, in [0, π/2); turbidity in [1.7, 10], where the fit holds.
  PreethamSky(double sun_zenith_angle, double turbidity);

  /// Luminance at the zenith in cd/m² (the paper's formula gives kcd/m²).
  double zenith_luminance_cd_m2() const { return zenith_[0]; }

  /// Linear BT.709 radiance in cd/m² of a direction with cosine `cos_zenith` ≥ 0 to the zenith and `cos_sun`
  /// to the sun. The Perez terms are evaluated at most 89.9° from the zenith, where they have converged.
  /// Colours outside BT.709 lose their negative components: a display-sized set of primaries cannot hold
  /// them, and radiance is ≥ 0.
  Rgb radiance(double cos_zenith, double cos_sun) const;

 private:
  struct Perez {
    double a, b, c, d, e;
    double operator()(double cos_zenith, double gamma) const;
  };
  Perez perez_[3];       ///< Y, x, y
  double zenith_[3];     ///< Y in cd/m², x, y
  double at_zenith_[3];  ///< Perez value at the zenith
};

}  // namespace plenolab::tracer
