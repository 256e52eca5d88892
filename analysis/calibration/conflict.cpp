#include "analysis/calibration/conflict.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <optional>

#include "analysis/calibration/coordinates.h"

namespace plenolab {

namespace {

constexpr double kMostOutliers = 0.2;

/// Readings of one kind, or what is said of one parameter: its anchor or its fixed value.
struct Source {
  std::string name;
  std::string kind;                                 ///< of records
  std::optional<CalibrationParameter> parameter{};  ///< or this
  bool fixed = false;

  bool holds(const CalibrationResidual& residual, const CalibrationMeasurements& all) const {
    if (parameter || residual.anchor) return parameter == residual.anchor;
    return kind == kind_of(all.records[residual.record]);
  }
  void remove_from(CalibrationMeasurements& measurements) const {
    if (parameter)
      measurements.parameters[index_of(*parameter)].role = ParameterSetting::Role::kFree;
    else
      std::erase_if(measurements.records, [&](const CalibrationRecord& r) { return kind == kind_of(r); });
  }
};

std::vector<Source> sources_of(const CalibrationMeasurements& measurements) {
  std::vector<Source> sources;
  for (const CalibrationRecord& record : measurements.records) {
    const std::string kind = kind_of(record);
    if (std::none_of(sources.begin(), sources.end(), [&](const Source& s) { return s.kind == kind; }))
      sources.push_back({kind, kind});
  }
  for (std::size_t i = 0; i < measurements.parameters.size(); ++i) {
    const auto role = measurements.parameters[i].role;
    if (role == ParameterSetting::Role::kFree) continue;
    const bool fixed = role == ParameterSetting::Role::kFixed;
    sources.push_back({fmt::format("{} of {}", fixed ? "fixed value" : "anchor", traits_of(i).symbol), "",
                       static_cast<CalibrationParameter>(i), fixed});
  }
  return sources;
}

LeftOutReading farthest(const Source& source, const CalibrationMeasurements& all, const CalibrationFit& fit) {
  if (source.fixed) {
    const std::size_t i = index_of(*source.parameter);
    return {traits_of(i).name, all.parameters[i].nominal, fit.values[i], 0};
  }
  LeftOutReading worst;
  for (const CalibrationResidual& residual : residuals_of(all)) {
    if (!source.holds(residual, all)) continue;
    const double measured = reading_of(residual, all);
    const double predicted = prediction_of(residual, all, fit.geometry);
    const double deviations = (predicted - measured) / deviation_of(residual, all);
    if (worst.what.empty() || std::abs(deviations) > std::abs(worst.deviations))
      worst = {reading_name(residual, all), measured, predicted, deviations};
  }
  return worst;
}

bool is_determined(const CalibrationFit& fit) {
  return fit.converged && fit.uncertainty.open.empty();
}

/// Nothing if no record would be left, or if a parameter that was fixed is not determined by the rest.
std::optional<DoubtedSource> fit_without(const std::vector<Source>& left_out,
                                         const CalibrationMeasurements& all,
                                         const CalibrationFitOptions& options) {
  CalibrationMeasurements rest = all;
  DoubtedSource doubt;
  for (const Source& source : left_out) {
    source.remove_from(rest);
    doubt.source += (doubt.source.empty() ? "" : " + ") + source.name;
  }
  if (rest.records.empty()) return std::nullopt;
  if (left_out.empty()) doubt.source = "nothing";
  doubt.fit = fit_calibration(rest, options);
  const bool frees_fixed =
      std::any_of(left_out.begin(), left_out.end(), [](const Source& source) { return source.fixed; });
  if (frees_fixed && !is_determined(doubt.fit)) return std::nullopt;
  if (is_determined(doubt.fit))
    for (const Source& source : left_out) doubt.left_out.push_back(farthest(source, all, doubt.fit));
  return doubt;
}

bool reconciles(const DoubtedSource& doubt) {
  return !doubt.left_out.empty() && !contradicts(doubt.fit);
}

}  // namespace

bool isolated_outliers(const CalibrationFit& fit) {
  double chi2 = fit.chi2;
  int outliers = 0;
  for (const FittedReading& reading : fit.readings)
    if (reading.outlier) chi2 -= reading.deviations * reading.deviations, ++outliers;
  const int freedom = fit.degrees_of_freedom - outliers;
  if (outliers == 0 || outliers > kMostOutliers * static_cast<double>(fit.readings.size()) || freedom < 1)
    return false;
  return boost::math::gamma_q(freedom / 2.0, std::max(0.0, chi2) / 2) >= kContradiction;
}

std::vector<DoubtedSource> doubt_each_source(const CalibrationMeasurements& measurements,
                                             CalibrationFitOptions options) {
  options.loss = CalibrationLoss::kNone;
  const std::vector<Source> sources = sources_of(measurements);
  std::vector<DoubtedSource> doubts{*fit_without({}, measurements, options)};
  for (const Source& source : sources)
    if (auto doubt = fit_without({source}, measurements, options)) doubts.push_back(std::move(*doubt));
  if (!contradicts(doubts.front().fit) || std::any_of(doubts.begin(), doubts.end(), reconciles))
    return doubts;
  for (std::size_t i = 0; i < sources.size(); ++i)
    for (std::size_t j = i + 1; j < sources.size(); ++j)
      if (auto doubt = fit_without({sources[i], sources[j]}, measurements, options);
          doubt && reconciles(*doubt) && doubt->fit.degrees_of_freedom > 0)
        doubts.push_back(std::move(*doubt));
  return doubts;
}

}  // namespace plenolab
