#pragma once

#include "core/display/near_eye_optics.h"
#include "core/image/image.h"

namespace plenolab {

/// The eye before the display. Positions in millimetres from the point on the axis of the array at the eye
/// relief, x to the right, y down; z moves the eye towards the lenses.
struct Eye {
  double x_mm = 0, y_mm = 0, z_mm = 0;
  double pupil_mm = 4;           ///< diameter; 0 = a pinhole, for which everything is in focus
  double focus_mm = 1000;        ///< distance of the plane the eye accommodates to, may be ∞
  double field_of_view_deg = 0;  ///< horizontal, of the picture; 0 = that of the array from the eye relief

  /// Throws InputError with one sentence that names the first value out of range for this display.
  void validate(const NearEyeDisplay& display) const;
};

struct RetinaOptions {
  int width = 480;         ///< px of the picture; the height follows the array's shape
  int pupil_samples = 64;  ///< rays a pixel, spread over the pupil; 1 for a pinhole
  int threads = 0;         ///< no influence on the result

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// What the eye sees through the lenses, upright. Every pixel is a point on the plane the eye focuses on;
/// from there rays run through points of the pupil (the same for all pixels), backwards to the lens they meet
/// (square apertures without gaps), through it as through a thin lens, and onto the panel, which is read
/// bilinearly. So the eye's own blur, that of the lenses, and light that a lens takes from its neighbour's
/// subimage are all there; diffraction and aberrations are not. Black beyond the array and the panel. Codes
/// of the panel are averaged as light (gamma 2.2).
DisplayImage retinal_image(const DisplayImage& panel, const NearEyeDisplay& display, const Eye& eye,
                           const RetinaOptions& options = {});

}  // namespace plenolab
