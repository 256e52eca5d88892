#include "analysis/calibration/conflict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/calibration/coordinates.h"

namespace plenolab {

namespace {

std::vector<std::string> kinds_in(const CalibrationMeasurements& measurements) {
  std::vector<std::string> kinds;
  for (const CalibrationRecord& record : measurements.records)
    if (std::find(kinds.begin(), kinds.end(), kind_of(record)) == kinds.end())
      kinds.emplace_back(kind_of(record));
  return kinds;
}

/// The reading of the full fit's list that the fit without it contradicts most.
std::optional<DoubtedSource::LeftOut> farthest(const CalibrationMeasurements& all,
                                               const std::vector<FittedReading>& readings,
                                               const CalibrationFit& without, const auto& is_left_out) {
  std::optional<DoubtedSource::LeftOut> worst;
  const auto residuals = residuals_of(all);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!is_left_out(readings[i])) continue;
    const double predicted = prediction_of(residuals[i], all, without.geometry);
    const double deviations = (predicted - readings[i].measured) / readings[i].sd;
    if (!worst || std::abs(deviations) > std::abs(worst->deviations))
      worst = DoubtedSource::LeftOut{readings[i].what, readings[i].measured, predicted, deviations};
  }
  return worst;
}

/// Whether the fit still determines every parameter that is asked for.
bool determines_all(const CalibrationFit& fit) {
  return fit.converged && fit.uncertainty.open.empty();
}

}  // namespace

std::vector<DoubtedSource> doubt_each_source(const CalibrationMeasurements& measurements,
                                             const CalibrationFitOptions& options) {
  std::vector<DoubtedSource> doubts;
  doubts.push_back({"nothing", fit_calibration(measurements, options), std::nullopt});
  const std::vector<FittedReading> readings = doubts.front().fit.readings;
  const auto add = [&](const std::string& source, const CalibrationMeasurements& without,
                       const auto& is_left_out) {
    DoubtedSource doubt{source, fit_calibration(without, options), std::nullopt};
    if (determines_all(doubt.fit)) doubt.left_out = farthest(measurements, readings, doubt.fit, is_left_out);
    doubts.push_back(std::move(doubt));
  };
  const std::vector<std::string> kinds = kinds_in(measurements);
  for (const std::string& kind : kinds) {
    if (kinds.size() == 1) break;  // nothing would be left to fit to
    CalibrationMeasurements without = measurements;
    std::erase_if(without.records, [&](const CalibrationRecord& record) { return kind == kind_of(record); });
    add(kind + " readings", without, [&](const FittedReading& r) { return r.kind == kind; });
  }
  for (std::size_t i = 0; i < measurements.parameters.size(); ++i) {
    if (measurements.parameters[i].role != ParameterSetting::Role::kAnchored) continue;
    CalibrationMeasurements without = measurements;
    without.parameters[i].role = ParameterSetting::Role::kFree;
    add(fmt::format("the anchor of {}", traits_of(i).symbol), without,
        [&](const FittedReading& r) { return r.kind == "anchor" && r.record == i; });
  }
  return doubts;
}

}  // namespace plenolab
