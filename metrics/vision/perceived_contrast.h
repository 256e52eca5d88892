#pragma once

#include "metrics/viewing_conditions.h"

namespace plenolab::vision {

/// What a viewer's eye makes of luminance, in JND: the front end of HDR-VDP 1 (metrics/vision/eye.h).
///  1. optics: blur by the eye's transfer function, with the pupil of the image's arithmetic mean luminance;
///  2. the JND scale;
///  3. contrast sensitivity: filters for viewers adapted to 0.001, 0.01 … 100 cd/m², interpolated at each
///     pixel to its blurred luminance (linearly over its logarithm, the ends beyond). As JND have the
///     threshold at the peak in them already, each filter is the sensitivity over its peak; as the optics are
///     a step of their own, it is divided by them; it is cut at 1, and the mean is removed (0 at ρ = 0).
/// The optics are cut at the image's highest frequency, so that a pixel millions of times brighter than what
/// is around it, a sun, not only veils it, as it does in the eye, but also rings along its row and column.
/// Values are contrasts about 0: 1 is just visible where sensitivity is best.
///
/// Luminance in cd/m², finite, of at least one pixel. Bit-identical for any number of threads.
Plane<float> perceived_contrast(const Plane<float>& luminance_cd_m2, const ViewingConditions& viewing,
                                int threads);

/// The filter of step 3 for one adaptation.
class SensitivityFilter {
 public:
  SensitivityFilter(double adaptation_cd_m2, double pupil_mm, const ViewingConditions& viewing);

  /// Response in [0, 1] at a frequency in cycles per pixel.
  double operator()(double x, double y) const;

 private:
  double basic(double frequency_cpd) const;

  double pixels_per_degree_;
  double falloff_axis_, falloff_diagonal_;
  double steps_per_cpd_;
  std::vector<float> basic_;     ///< S1 over its peak, at equal steps
  std::vector<float> transfer_;  ///< the optics at the same steps
};

}  // namespace plenolab::vision
