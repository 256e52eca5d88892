#include "core/display/near_eye_optics.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

void require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("the {} of the display must be a positive number, not {:g}", name, value));
}

}  // namespace

void NearEyeDisplay::validate() const {
  require_positive(focal_length_mm, "focal length in mm");
  require_positive(lens_pitch_mm, "lens pitch in mm");
  require_positive(eye_relief_mm, "eye relief in mm");
  require_positive(pixel_pitch_mm, "pixel pitch in mm");
  require_positive(subimage_pitch_px, "subimage pitch in px");
  if (!(image_distance_mm > eye_relief_mm))
    throw InputError(
        fmt::format("the virtual image must lie beyond the lenses, {:g} mm from the eye, not at {:g} mm",
                    eye_relief_mm, image_distance_mm));
  if (!(rendered_fov_deg > 0 && rendered_fov_deg < 180))
    throw InputError(fmt::format(
        "the field of view of a subimage must lie between 0 and 180 degrees, not {:g}", rendered_fov_deg));
  if (columns < 1 || rows < 1)
    throw InputError(fmt::format("the display needs at least one lens, not {} × {}", columns, rows));
  if (panel_width < columns * subimage_pitch_px || panel_height < rows * subimage_pitch_px)
    throw InputError(fmt::format("{} × {} subimages, {:g} px apart, do not fit a panel of {} × {} px",
                                 columns, rows, subimage_pitch_px, panel_width, panel_height));
}

double lens_separation_mm(const NearEyeDisplay& display) {
  const double to_image = display.image_distance_mm - display.eye_relief_mm;
  // Divided by the image distance, so that an image at infinity needs no case of its own.
  return display.focal_length_mm / (display.focal_length_mm / to_image + 1);
}

double magnification(const NearEyeDisplay& display) {
  return 1 + (display.image_distance_mm - display.eye_relief_mm) / display.focal_length_mm;
}

double lens_field_of_view_deg(double width_mm, double separation_mm) {
  return 2 * std::atan(width_mm / (2 * separation_mm)) / kDegree;
}

double separation_for_field_of_view_mm(double width_mm, double fov_deg) {
  return width_mm / (2 * std::tan(fov_deg * kDegree / 2));
}

double total_field_of_view_deg(const NearEyeDisplay& display, int lenses) {
  return lens_field_of_view_deg(lenses * display.lens_pitch_mm, display.eye_relief_mm);
}

double spatial_resolution_px(const NearEyeDisplay& display, double total_fov_deg) {
  return 2 * display.image_distance_mm * std::tan(total_fov_deg * kDegree / 2) /
         (magnification(display) * display.pixel_pitch_mm);
}

CircleOfConfusion circle_of_confusion(const NearEyeDisplay& display, double distance_mm) {
  const double to_image = display.image_distance_mm - display.eye_relief_mm;
  return {std::abs(distance_mm - display.image_distance_mm) / to_image * display.lens_pitch_mm,
          (distance_mm - display.eye_relief_mm) / lens_separation_mm(display) * display.pixel_pitch_mm};
}

DepthOfField depth_of_field(const NearEyeDisplay& display) {
  const double optical = display.lens_pitch_mm / (display.image_distance_mm - display.eye_relief_mm);
  const double pixel = display.pixel_pitch_mm / lens_separation_mm(display);
  // optical·(d_0 − d) = pixel·(d − d_e) on the near side; optical·(d − d_0) = pixel·(d − d_e) on the far one.
  const double near_mm =
      (optical * display.image_distance_mm + pixel * display.eye_relief_mm) / (optical + pixel);
  const double far_mm =
      optical > pixel
          ? (optical * display.image_distance_mm - pixel * display.eye_relief_mm) / (optical - pixel)
          : std::numeric_limits<double>::infinity();
  return {near_mm, far_mm};
}

double apparent_depth_mm(const NearEyeDisplay& display, double depth_mm) {
  const double separation = lens_separation_mm(display);
  const double subimage_mm = display.subimage_pitch_px * display.pixel_pitch_mm;
  // A point at depth Z stands 1/Z of a slope lower for each mm the lens is higher; on the panel that is a
  // length of the camera's image distance, and subimages closer than lenses add to it.
  const double image_distance_mm = separation_for_field_of_view_mm(subimage_mm, display.rendered_fov_deg);
  const double slope_per_mm =
      image_distance_mm / separation / depth_mm + (1 - subimage_mm / display.lens_pitch_mm) / separation;
  // What rounding leaves of parallel rays is not a distance.
  return std::abs(slope_per_mm) < 1e-12 ? std::numeric_limits<double>::infinity() : 1 / slope_per_mm;
}

NearEyeDisplay consistent_with_thin_lenses(NearEyeDisplay display) {
  display.subimage_pitch_px = display.lens_pitch_mm / display.pixel_pitch_mm;
  display.rendered_fov_deg = lens_field_of_view_deg(display.lens_pitch_mm, lens_separation_mm(display));
  return display;
}

}  // namespace plenolab
