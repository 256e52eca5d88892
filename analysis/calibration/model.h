#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "analysis/calibration/measurements.h"

namespace plenolab {

/// The forward model: what an instrument with a given geometry makes a measurement read. Thin lenses, chief
/// rays; everything is a template over the number type so that derivatives come exactly, by dual numbers.
///
/// With the chief ray, the point of the panel at x from the axis of its lens is seen at the slope x/d_l, and
/// subimages are upright (the panel lies within the focal length).

/// A geometry. Lengths in mm. The focus is kept as the vergence 1/d_l − 1/f, which is 0 at d_l = f and smooth
/// beyond it, where the distance of the virtual image would diverge.
template <class T>
struct DisplayGeometry {
  T pixel_pitch, lens_pitch, lens_distance;
  T vergence_per_mm;  ///< 1/d_l − 1/f
  T offset_x, offset_y, rotation_rad, pupil_offset;
  T sharpness, sharpness_width;

  /// f = d_l/(1 − V·d_l), without cancellation for any V.
  T focal_length() const { return lens_distance / (1.0 - vergence_per_mm * lens_distance); }
  /// f − d_l = V·d_l·f, exact however small.
  T focal_gap() const { return vergence_per_mm * lens_distance * focal_length(); }
};

inline constexpr double kDioptresPerMm = 1000;  ///< 1/mm in 1/m

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

/// By how many subimages a target at this depth moves from one virtual camera to the next:
/// spacing/(2 z tan(α/2)).
inline double subimage_shift(const CalibrationInstrument& instrument, double virtual_depth_mm) {
  return instrument.camera_spacing_mm /
         (2 * virtual_depth_mm * std::tan(radians(instrument.render_fov_deg) / 2));
}

/// Reciprocal distance from the lenses, in 1/mm, of the point where the chief rays of all lenses to a target
/// meet, with subimages of `subimage_mm` width and pitch.
template <class T>
T light_field_vergence(const DisplayGeometry<T>& g, const CalibrationInstrument& instrument,
                       const T& subimage_mm, double virtual_depth_mm) {
  return (subimage_mm * subimage_shift(instrument, virtual_depth_mm) + g.lens_pitch - subimage_mm) /
         (g.lens_pitch * g.lens_distance);
}

template <class T>
T subimage_width(const DisplayGeometry<T>& g, const CalibrationInstrument& instrument) {
  return g.pixel_pitch * instrument.subimage_px;
}

/// α = 2·atan(subimage/(2 d_l)), equation 3.3.
template <class T>
T field_of_view_rad(const DisplayGeometry<T>& g, const CalibrationInstrument& instrument) {
  using std::atan;
  return 2.0 * atan(subimage_width(g, instrument) / (2.0 * g.lens_distance));
}

/// The screen scale at which the light field converges where the eye sees pixels sharp:
/// subimage·(1 − shift)/scale = w_l·(1 − V·d_l).
template <class T>
T sharpest_scale(const DisplayGeometry<T>& g, const CalibrationInstrument& instrument,
                 double virtual_depth_mm) {
  return subimage_width(g, instrument) * (1 - subimage_shift(instrument, virtual_depth_mm)) /
         (g.lens_pitch * (1.0 - g.vergence_per_mm * g.lens_distance));
}

/// The readings that a record would have (readings_in of them are set).
template <class T>
using Readings = std::array<T, 2>;

template <class T>
Readings<T> predict(const EdgeRecord& r, const DisplayGeometry<T>& g, const CalibrationInstrument& i) {
  const T offset = r.axis == CalibrationAxis::kX ? g.offset_x : g.offset_y;
  const T edge = 0.5 * subimage_width(g, i) + static_cast<double>(r.side) * offset;
  return {(r.camera_height_mm + g.pupil_offset) * edge / g.lens_distance, T(0)};
}

template <class T>
Readings<T> predict(const FieldOfViewRecord&, const DisplayGeometry<T>& g, const CalibrationInstrument& i) {
  return {field_of_view_rad(g, i) * (180 / std::numbers::pi), T(0)};
}

template <class T>
Readings<T> predict(const TargetRecord& r, const DisplayGeometry<T>& g, const CalibrationInstrument& i) {
  const T subimage = subimage_width(g, i);
  const double across = std::tan(radians(r.target_angle_deg)) / (2 * std::tan(radians(i.render_fov_deg) / 2));
  const T slope = (subimage * across - g.offset_x) / g.lens_distance;
  const T vergence = light_field_vergence(g, i, subimage, r.virtual_depth_mm);
  return {(slope - std::tan(radians(r.camera_angle_deg))) /
              (vergence + 1.0 / (r.camera_height_mm + g.pupil_offset)),
          T(0)};
}

template <class T>
Readings<T> predict(const FocusRecord&, const DisplayGeometry<T>& g, const CalibrationInstrument&) {
  return {g.vergence_per_mm * kDioptresPerMm, T(0)};
}

template <class T>
Readings<T> predict(const GridRecord& r, const DisplayGeometry<T>& g, const CalibrationInstrument&) {
  using std::cos;
  using std::sin;
  const double column = r.column, row = r.row;
  const T c = cos(g.rotation_rad), s = sin(g.rotation_rad);
  return {(g.offset_x + g.lens_pitch * (c * column - s * row)) / g.pixel_pitch,
          (g.offset_y + g.lens_pitch * (s * column + c * row)) / g.pixel_pitch};
}

/// A Lorentz curve about the sharpest scale, its width and height left to the fit: the thesis prints none.
template <class T>
Readings<T> predict(const SharpnessRecord& r, const DisplayGeometry<T>& g, const CalibrationInstrument& i) {
  const T away = (r.scale - sharpest_scale(g, i, r.virtual_depth_mm)) / g.sharpness_width;
  return {g.sharpness / (1.0 + away * away), T(0)};
}

template <class T>
Readings<T> predict(const SharpestScaleRecord& r, const DisplayGeometry<T>& g,
                    const CalibrationInstrument& i) {
  return {sharpest_scale(g, i, r.virtual_depth_mm), T(0)};
}

template <class T>
Readings<T> predict(const CalibrationRecord& record, const DisplayGeometry<T>& geometry,
                    const CalibrationInstrument& instrument) {
  return std::visit([&](const auto& r) { return predict(r, geometry, instrument); }, record);
}

/// The value of one parameter, in its unit.
template <class T>
T parameter_value(const DisplayGeometry<T>& g, CalibrationParameter parameter) {
  switch (parameter) {
    case CalibrationParameter::kPixelPitch:
      return g.pixel_pitch;
    case CalibrationParameter::kLensPitch:
      return g.lens_pitch;
    case CalibrationParameter::kLensDistance:
      return g.lens_distance;
    case CalibrationParameter::kFocalLength:
      return g.focal_length();
    case CalibrationParameter::kOffsetX:
      return g.offset_x;
    case CalibrationParameter::kOffsetY:
      return g.offset_y;
    case CalibrationParameter::kRotation:
      return g.rotation_rad * (180 / std::numbers::pi);
    case CalibrationParameter::kPupilOffset:
      return g.pupil_offset;
    case CalibrationParameter::kSharpness:
      return g.sharpness;
    case CalibrationParameter::kSharpnessWidth:
      break;
  }
  return g.sharpness_width;
}

/// The geometry with these parameter values.
DisplayGeometry<double> geometry_of(const ParameterValues& values);

/// What was read in a record, and the standard deviation of a reading.
Readings<double> readings_of(const CalibrationRecord& record);
double deviation_of(const CalibrationRecord& record);
/// The same record with other readings.
CalibrationRecord with_readings(CalibrationRecord record, const Readings<double>& readings);

/// A number that the parameters imply, in words and formula: what may be determined where single lengths are
/// not.
struct DerivedQuantity {
  const char* name;    ///< in results: "fov_deg"
  const char* symbol;  ///< in sentences: "w_l/p"
  const char* unit;
  const char* meaning;
};

inline constexpr int kDerivedQuantities = 7;
using DerivedTraits = std::array<DerivedQuantity, kDerivedQuantities>;
const DerivedTraits& derived_quantities();

/// Their values, in the same order.
template <class T>
std::array<T, kDerivedQuantities> derived_values(const DisplayGeometry<T>& g,
                                                 const CalibrationInstrument& i) {
  return {field_of_view_rad(g, i) * (180 / std::numbers::pi),
          g.lens_pitch / g.pixel_pitch,
          subimage_width(g, i) / g.lens_pitch,
          g.lens_pitch / g.lens_distance,
          g.vergence_per_mm * kDioptresPerMm,
          1.0 - g.vergence_per_mm * g.lens_distance,
          g.focal_gap()};
}

}  // namespace plenolab
