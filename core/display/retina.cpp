#include "core/display/retina.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

constexpr float kOutside = -1e9f;

/// Points spread evenly over a disc of diameter 1 (Vogel's spiral).
std::vector<std::array<double, 2>> disc_points(int count) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < count; ++i) {
    const double r = 0.5 * std::sqrt((i + 0.5) / count);
    points.push_back({r * std::cos(golden * i), r * std::sin(golden * i)});
  }
  return points;
}

/// What all rays along one axis share.
struct Axis {
  double eye_mm, relief_mm, lens_factor, separation_mm, pitch_mm, pixel_mm;
  int lenses, panel_px;

  /// Panel coordinate in px (centres at integer + 0.5), or kOutside.
  float panel_px_of(double pupil_mm, double slope) const {
    const double at_lens = pupil_mm + slope * relief_mm;
    const double index = std::floor(at_lens / pitch_mm + lenses / 2.0);
    if (!(index >= 0 && index < lenses)) return kOutside;
    const double centre = (index + 0.5 - lenses / 2.0) * pitch_mm;
    const double hit_mm = centre + (at_lens - centre) * lens_factor + separation_mm * slope;
    const double px = hit_mm / pixel_mm + panel_px / 2.0;
    return px >= 0 && px < panel_px ? static_cast<float>(px) : kOutside;
  }
};

Axis make_axis(const NearEyeDisplay& display, double eye_mm, double relief_mm, int lenses, int panel_px) {
  const double separation = lens_separation_mm(display);
  return {eye_mm,
          relief_mm,
          1 - separation / display.focal_length_mm,
          separation,
          display.lens_pitch_mm,
          display.pixel_pitch_mm,
          lenses,
          panel_px};
}

/// For each pixel along an axis and each pupil point: where it reads the panel.
std::vector<float> trace_axis(const Axis& axis, int pixels, double half_slope, double focus_mm,
                              const std::vector<double>& pupil_mm) {
  std::vector<float> hits;
  hits.reserve(static_cast<std::size_t>(pixels) * pupil_mm.size());
  for (int i = 0; i < pixels; ++i) {
    const double slope = half_slope * (2 * (i + 0.5) / pixels - 1);
    // A pupil point `a` off the centre sees the same point of the focus plane under slope − a / focus.
    for (const double a : pupil_mm) hits.push_back(axis.panel_px_of(axis.eye_mm + a, slope - a / focus_mm));
  }
  return hits;
}

/// Decoded panel, read bilinearly and clamped at its border.
Rgb read_panel(const Plane<Rgb>& light, float x, float y) {
  const float u = std::clamp(x - 0.5f, 0.0f, static_cast<float>(light.width() - 1)),
              v = std::clamp(y - 0.5f, 0.0f, static_cast<float>(light.height() - 1));
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int i1 = std::min(i + 1, light.width() - 1), j1 = std::min(j + 1, light.height() - 1);
  const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
  const Rgb top = light.at(i, j) * (1 - fx) + light.at(i1, j) * fx,
            bottom = light.at(i, j1) * (1 - fx) + light.at(i1, j1) * fx;
  return top * (1 - fy) + bottom * fy;
}

Plane<Rgb> as_light(const DisplayImage& panel) {
  Plane<Rgb> light(panel.width(), panel.height());
  std::transform(panel.pixels().begin(), panel.pixels().end(), light.pixels().begin(),
                 [](Rgb code) { return gamma_decode(code); });
  return light;
}

}  // namespace

void Eye::validate(const NearEyeDisplay& display) const {
  const double relief = display.eye_relief_mm - z_mm;
  if (!(relief > 0))
    throw InputError(fmt::format("the eye at z = {:g} mm is not in front of the lenses, {:g} mm away", z_mm,
                                 display.eye_relief_mm));
  if (!std::isfinite(x_mm) || !std::isfinite(y_mm)) throw InputError("the position of the eye is not finite");
  if (!(pupil_mm >= 0 && pupil_mm <= 20))
    throw InputError(fmt::format("the pupil must be 0 to 20 mm wide, not {:g}", pupil_mm));
  if (!(focus_mm > relief))
    throw InputError(
        fmt::format("the eye must focus beyond the lenses, {:g} mm away, not at {:g} mm", relief, focus_mm));
  if (!(field_of_view_deg >= 0 && field_of_view_deg < 180))
    throw InputError(fmt::format("the field of view of the eye must lie between 0 and 180 degrees, not {:g}",
                                 field_of_view_deg));
}

void RetinaOptions::validate() const {
  if (width < 1 || width > 16384)
    throw InputError(fmt::format("a retinal image of {} px across cannot be made", width));
  if (pupil_samples < 1 || pupil_samples > 4096)
    throw InputError(fmt::format("the pupil takes 1 to 4096 samples, not {}", pupil_samples));
}

DisplayImage retinal_image(const DisplayImage& panel, const NearEyeDisplay& display, const Eye& eye,
                           const RetinaOptions& options) {
  display.validate();
  eye.validate(display);
  options.validate();
  if (panel.width() != display.panel_width || panel.height() != display.panel_height)
    throw InputError(fmt::format("the panel has {} × {} px, its image {} × {}", display.panel_width,
                                 display.panel_height, panel.width(), panel.height()));
  const double relief = display.eye_relief_mm - eye.z_mm;
  const double fov =
      eye.field_of_view_deg > 0 ? eye.field_of_view_deg : total_field_of_view_deg(display, display.columns);
  const double half_x = std::tan(fov * std::numbers::pi / 360);
  const int height = std::max(
      1, static_cast<int>(std::lround(options.width * static_cast<double>(display.rows) / display.columns)));
  const double half_y = half_x * height / options.width;
  const auto disc = disc_points(eye.pupil_mm > 0 ? options.pupil_samples : 1);
  std::vector<double> pupil_x, pupil_y;
  for (const auto& [x, y] : disc) pupil_x.push_back(x * eye.pupil_mm), pupil_y.push_back(y * eye.pupil_mm);
  const std::vector<float> xs =
      trace_axis(make_axis(display, eye.x_mm, relief, display.columns, display.panel_width), options.width,
                 half_x, eye.focus_mm, pupil_x);
  const std::vector<float> ys =
      trace_axis(make_axis(display, eye.y_mm, relief, display.rows, display.panel_height), height, half_y,
                 eye.focus_mm, pupil_y);
  const Plane<Rgb> light = as_light(panel);
  const std::size_t samples = disc.size();
  DisplayImage image(options.width, height);
  parallel_for(height, 4, options.threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < options.width; ++x) {
        const float* at_x = xs.data() + static_cast<std::size_t>(x) * samples;
        const float* at_y = ys.data() + static_cast<std::size_t>(y) * samples;
        Rgb sum;
        for (std::size_t i = 0; i < samples; ++i)
          if (at_x[i] != kOutside && at_y[i] != kOutside) sum += read_panel(light, at_x[i], at_y[i]);
        const Rgb code = gamma_encode(sum * (1.0f / static_cast<float>(samples)));
        image.at(x, y) = {std::min(code.r, 1.0f), std::min(code.g, 1.0f), std::min(code.b, 1.0f)};
      }
  });
  return image;
}

}  // namespace plenolab
