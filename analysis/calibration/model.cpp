#include "analysis/calibration/model.h"

#include "analysis/calibration/record_fields.h"

namespace plenolab {

DisplayGeometry<double> geometry_of(const ParameterValues& values) {
  const auto value = [&](CalibrationParameter p) { return values[index_of(p)]; };
  using P = CalibrationParameter;
  const double d = value(P::kLensDistance), f = value(P::kFocalLength);
  return {value(P::kPixelPitch),
          value(P::kLensPitch),
          d,
          (f - d) / (f * d),
          value(P::kOffsetX),
          value(P::kOffsetY),
          radians(value(P::kRotation)),
          value(P::kPupilOffset),
          value(P::kSharpness),
          value(P::kSharpnessWidth)};
}

Readings<double> readings_of(const CalibrationRecord& record) {
  Readings<double> readings{};
  std::size_t next = 0;
  std::visit(
      [&](const auto& r) {
        for_each_number(r, [&](const RecordField& field, double value) {
          if (field.role == RecordField::Role::kReading) readings[next++] = value;
        });
      },
      record);
  return readings;
}

double deviation_of(const CalibrationRecord& record) {
  double deviation = 0;
  std::visit(
      [&](const auto& r) {
        for_each_number(r, [&](const RecordField& field, double value) {
          if (field.role == RecordField::Role::kDeviation) deviation = value;
        });
      },
      record);
  return deviation;
}

CalibrationRecord with_readings(CalibrationRecord record, const Readings<double>& readings) {
  std::size_t next = 0;
  std::visit(
      [&](auto& r) {
        for_each_number(r, [&](const RecordField& field, double& value) {
          if (field.role == RecordField::Role::kReading) value = readings[next++];
        });
      },
      record);
  return record;
}

const DerivedTraits& derived_quantities() {
  static constexpr DerivedTraits kTable{{
      {"fov_deg", "field of view", "deg", "field of view of one subimage, 2 atan(subimage/(2 d_l))"},
      {"lens_pitch_px", "w_l/p", "px", "lens pitch in pixels"},
      {"subimage_per_lens", "subimage/w_l", "1", "subimage width over lens pitch: the matching screen scale"},
      {"lens_pitch_over_d_l", "w_l/d_l", "1", "lens pitch over its distance from the panel"},
      {"vergence_dpt", "1/d_l − 1/f", "dpt", "vergence of the panel's virtual image"},
      {"d_l_over_f", "d_l/f", "1", "lens distance over focal length"},
      {"focal_gap_mm", "f − d_l", "mm", "what the lens distance falls short of the focal length"},
  }};
  return kTable;
}

}  // namespace plenolab
