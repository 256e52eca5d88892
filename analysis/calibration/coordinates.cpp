#include "analysis/calibration/coordinates.h"

#include "analysis/calibration/record_fields.h"

namespace plenolab {

namespace {

/// Where nothing was seen by a camera, a height that the thesis' set-up could have had.
constexpr double kUsualCameraHeight_mm = 100;

double mean_camera_height_mm(const CalibrationMeasurements& measurements) {
  double sum = 0;
  int count = 0;
  const auto add = [&](double height_mm) { sum += height_mm, ++count; };
  for (const CalibrationRecord& record : measurements.records) {
    if (const auto* edge = std::get_if<EdgeRecord>(&record)) add(edge->camera_height_mm);
    if (const auto* target = std::get_if<TargetRecord>(&record)) add(target->camera_height_mm);
  }
  return count ? sum / count : kUsualCameraHeight_mm;
}

}  // namespace

CalibrationCoordinates::CalibrationCoordinates(const CalibrationMeasurements& measurements)
    : camera_height_mm_(mean_camera_height_mm(measurements)) {
  for (std::size_t i = 0; i < nominal_.size(); ++i) nominal_[i] = measurements.parameters[i].nominal;
  focal_length_fixed_ = measurements.parameters[index_of(CalibrationParameter::kFocalLength)].role ==
                        ParameterSetting::Role::kFixed;
}

double CalibrationCoordinates::unit_of(std::size_t parameter) const {
  if (traits_of(parameter).positive) return nominal_[parameter];
  switch (static_cast<CalibrationParameter>(parameter)) {
    case CalibrationParameter::kRotation:
      return kUsefulRotation_deg;
    case CalibrationParameter::kPupilOffset:
      return camera_height_mm_;
    default:
      return lens_pitch_mm();
  }
}

ParameterValues CalibrationCoordinates::nominal() const {
  ParameterValues x{};
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!traits_of(i).positive) x[i] = nominal_[i] / unit_of(i);
  x[index_of(CalibrationParameter::kFocalLength)] = geometry_of(nominal_).vergence_per_mm * focal_length_mm();
  return x;
}

std::vector<CalibrationResidual> residuals_of(const CalibrationMeasurements& measurements) {
  std::vector<CalibrationResidual> residuals;
  for (std::size_t i = 0; i < measurements.records.size(); ++i)
    for (int c = 0; c < readings_in(measurements.records[i]); ++c)
      residuals.push_back({i, static_cast<std::size_t>(c), std::nullopt});
  for (std::size_t i = 0; i < measurements.parameters.size(); ++i)
    if (measurements.parameters[i].role == ParameterSetting::Role::kAnchored)
      residuals.push_back({0, 0, static_cast<CalibrationParameter>(i)});
  return residuals;
}

double reading_of(const CalibrationResidual& residual, const CalibrationMeasurements& measurements) {
  if (residual.anchor) return measurements.parameters[index_of(*residual.anchor)].nominal;
  return readings_of(measurements.records[residual.record])[residual.component];
}

double deviation_of(const CalibrationResidual& residual, const CalibrationMeasurements& measurements) {
  if (residual.anchor) return measurements.parameters[index_of(*residual.anchor)].sd;
  return deviation_of(measurements.records[residual.record]);
}

std::string reading_name(const CalibrationResidual& residual, const CalibrationMeasurements& measurements) {
  if (residual.anchor) return traits_of(*residual.anchor).name;
  std::vector<std::string> names;
  std::visit(
      [&](const auto& r) {
        for_each_number(r, [&](const RecordField& field, double) {
          if (field.role == RecordField::Role::kReading) names.emplace_back(field.name);
        });
      },
      measurements.records[residual.record]);
  return names[residual.component];
}

DisplayGeometry<CalibrationJet> geometry_with_derivatives(const CalibrationCoordinates& coordinates,
                                                          const ParameterValues& x) {
  std::array<CalibrationJet, kCalibrationParameters> jets;
  for (std::size_t i = 0; i < jets.size(); ++i) jets[i] = CalibrationJet(x[i], static_cast<int>(i));
  return coordinates.geometry(jets.data());
}

}  // namespace plenolab
