#include "analysis/calibration/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/calibration/model.h"
#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kReadingNoise = 0x63616c6962726561ull, kAnchorNoise = 0x63616c6962616e63ull,
                        kOutliers = 0x63616c69626f7574ull;

/// Standard normal (Box & Muller 1958).
double normal(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index) {
  const double u = unit_double(random_u64(seed, purpose, 2 * index));
  const double v = unit_double(random_u64(seed, purpose, 2 * index + 1));
  return std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * v);
}

/// In deviations: noise, or for a reading drawn as an outlier a fixed distance either way.
double error_of_reading(const CalibrationRig& rig, std::uint64_t seed, std::uint64_t index) {
  if (unit_double(random_u64(seed, kOutliers, 2 * index)) < rig.outlier_share)
    return unit_double(random_u64(seed, kOutliers, 2 * index + 1)) < 0.5 ? rig.outlier_deviations
                                                                         : -rig.outlier_deviations;
  return normal(seed, kReadingNoise, index);
}

/// To a hundredth of the deviation or finer, as a person would note it down.
double as_noted_down(double reading, double deviation) {
  const double scale = std::pow(10, std::max(0.0, 2 - std::floor(std::log10(deviation))));
  const double rounded = std::round(reading * scale) / scale;
  return std::isfinite(rounded) ? rounded : reading;
}

}  // namespace

void CalibrationRig::validate(const std::string& name) const {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const ParameterTraits& traits = traits_of(i);
    const double low = traits.positive ? 1e-9 : -1e6;
    if (!(truth[i] >= low && truth[i] <= 1e6))
      throw InputError(
          fmt::format("{}: truth.{} must lie in [{}, 1e6], not {}", name, traits.name, low, truth[i]));
  }
  if (!(outlier_share >= 0 && outlier_share <= 1))
    throw InputError(fmt::format("{}: outliers.share must lie in [0, 1], not {}", name, outlier_share));
  if (!(std::abs(outlier_deviations) <= 1e6))
    throw InputError(
        fmt::format("{}: outliers.deviations must lie within a million, not {}", name, outlier_deviations));
  exact_measurements(*this).validate(name);
}

CalibrationMeasurements exact_measurements(const CalibrationRig& rig) {
  CalibrationMeasurements measurements = rig.plan;
  const DisplayGeometry<double> geometry = geometry_of(rig.truth);
  for (CalibrationRecord& record : measurements.records)
    record = with_readings(record, predict(record, geometry, measurements.instrument));
  return measurements;
}

CalibrationMeasurements simulate_measurements(const CalibrationRig& rig, std::uint64_t seed) {
  CalibrationMeasurements measurements = exact_measurements(rig);
  std::uint64_t index = 0;
  for (CalibrationRecord& record : measurements.records) {
    Readings<double> readings = readings_of(record);
    const double sd = deviation_of(record);
    for (double& reading : readings)
      reading = as_noted_down(reading + sd * error_of_reading(rig, seed, index++), sd);
    record = with_readings(record, readings);
  }
  for (std::size_t i = 0; i < measurements.parameters.size(); ++i)
    if (ParameterSetting& p = measurements.parameters[i]; p.role == ParameterSetting::Role::kAnchored)
      p.nominal = as_noted_down(rig.truth[i] + p.sd * normal(seed, kAnchorNoise, i), p.sd);
  return measurements;
}

}  // namespace plenolab
