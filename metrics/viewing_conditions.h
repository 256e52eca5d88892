#pragma once

#include "core/image/image.h"

namespace plenolab {

/// How images are looked at, for metrics that predict what a viewer sees. Apart from the metrics, so that all
/// numbers of a report are for the same viewer.
struct ViewingConditions {
  double pixels_per_degree = 29.8;  ///< pixels of the image in one degree of visual angle, [1, 1000]
  double distance_m = 0.5;          ///< from the eye to the picture, [0.05, 100]
  /// The display that display images are shown on: luminance of code 1, and of code 0.
  double display_peak_cd_m2 = 300;   ///< (0, 1e6]
  double display_black_cd_m2 = 0.3;  ///< [0, peak)

  /// Throws InputError naming the first value out of range.
  void validate() const;
  friend bool operator==(const ViewingConditions&, const ViewingConditions&) = default;
};

/// Luminance in cd/m² that the display of the conditions emits at each pixel:
/// black + (peak − black)·(luminance of the codes decoded with gamma 2.2). Codes outside [0, 1] count as the
/// nearer end.
Plane<float> displayed_luminance(const DisplayImage& image, const ViewingConditions& viewing);

/// Luminance in cd/m² of a scene whose value 1 is `cd_m2_per_unit`. Negative values of a channel count as 0,
/// as they do to tone mapping operators; luminance above 1e10 counts as 1e10 (six times the sun's).
Plane<float> scene_luminance(const SceneImage& image, double cd_m2_per_unit);

/// Luminance in units of the largest one, for what does not depend on the unit; 0 for a black image.
Plane<float> relative_luminance(const SceneImage& image);

}  // namespace plenolab
