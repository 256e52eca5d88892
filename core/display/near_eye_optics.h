#pragma once

#include "core/image/image.h"

namespace plenolab {

/// A near-eye light-field display: a microdisplay behind an array of small lenses, each of which shows the
/// eye its own subimage as a magnifier does (Lanman & Luebke 2013; Hansen & Klein 2016, section 3.1). Lengths
/// in millimetres; the defaults are those of the thesis.
struct NearEyeDisplay {
  double focal_length_mm = 3.3;     ///< f of a lens
  double lens_pitch_mm = 1;         ///< w_l: width of a lens and distance of neighbouring ones
  int columns = 15, rows = 8;       ///< lenses in use
  double eye_relief_mm = 35;        ///< d_e: from the pupil to the lenses
  double image_distance_mm = 1000;  ///< d_0: from the pupil to the virtual image; > eye relief, may be ∞
  int panel_width = 1280, panel_height = 720;  ///< pixels of the microdisplay
  double pixel_pitch_mm = 0.012;               ///< p
  double subimage_pitch_px = 80 + 1.0 / 3;     ///< panel pixels from one subimage to the next
  double rendered_fov_deg = 19.86;  ///< of the camera that renders a subimage, full angle (appendix C)

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// d_l, from the lenses to the panel, so that the virtual image lies at d_0 (equation 3.1):
/// f·(d_0 − d_e) / (f + d_0 − d_e); f for an image at infinity.
double lens_separation_mm(const NearEyeDisplay& display);

/// M of the virtual image over the panel (equation 3.2): (d_0 − d_e)/d_l = 1 + (d_0 − d_e)/f.
double magnification(const NearEyeDisplay& display);

/// α in degrees: what one lens shows of a subimage of width w_l (equation 3.3) at a separation d_l.
double lens_field_of_view_deg(double width_mm, double separation_mm);

/// d_l at which a thin lens shows `width_mm` under an angle of `fov_deg`: the inverse of the above.
double separation_for_field_of_view_mm(double width_mm, double fov_deg);

/// α_t in degrees of `lenses` lenses, seen from the eye (equation 3.4).
double total_field_of_view_deg(const NearEyeDisplay& display, int lenses);

/// N_p: pixels that the virtual image can resolve over a total field of view (equation 3.5), not rounded.
double spatial_resolution_px(const NearEyeDisplay& display, double total_fov_deg);

/// Parts of the circle of confusion c' of a point at `distance_mm` from the eye, on a plane at that distance
/// (equation 3.6). The printed first term has its sign lost: it is a length, and its absolute value is used.
struct CircleOfConfusion {
  double optical_mm = 0;  ///< |d' − d_0| / (d_0 − d_e) · w_l
  double pixel_mm = 0;    ///< (d' − d_e) / d_l · p
  double diameter_mm() const { return optical_mm > pixel_mm ? optical_mm : pixel_mm; }
};
CircleOfConfusion circle_of_confusion(const NearEyeDisplay& display, double distance_mm);

/// Distances from the eye between which the optical circle is no wider than the pixel.
struct DepthOfField {
  double near_mm = 0, far_mm = 0;  ///< far may be ∞
};
DepthOfField depth_of_field(const NearEyeDisplay& display);

/// Distance from the lenses at which rays of neighbouring lenses meet that show the same point of a scene,
/// rendered `depth_mm` from the cameras (∞ allowed), through thin lenses: vergence, what the eyes take for
/// its distance. Equal to the depth only if subimages are as far apart as lenses and rendered with the field
/// of view that d_l gives. ∞ for parallel rays, negative where they diverge.
double apparent_depth_mm(const NearEyeDisplay& display, double depth_mm);

/// The same display with the two numbers that contradict a thin lens replaced: subimages one lens apart,
/// rendered with the angle under which a lens shows its width.
NearEyeDisplay consistent_with_thin_lenses(NearEyeDisplay display);

}  // namespace plenolab
