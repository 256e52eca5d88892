#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/calibration/coverage.h"
#include "analysis/calibration/setups.h"
#include "experiments/calibration/calibration_results.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_calibration_coverage(Laboratory& laboratory);

namespace {

constexpr double kStated = 0.95;

struct OutlierRun {
  const char* loss;
  double share;
  CoverageResult result;
};

CoverageResult cover(const Laboratory& laboratory, CalibrationRig rig, double outliers, CalibrationLoss loss,
                     int rigs) {
  rig.outlier_share = outliers;
  rig.outlier_deviations = 20;
  CoverageOptions options{
      .rigs = rigs, .seed = laboratory.options().seed, .threads = laboratory.options().threads};
  options.fit.loss = loss;
  return measure_coverage(rig, options);
}

double share_of(const ParameterCoverage& c) {
  return c.fits ? static_cast<double>(c.covered) / c.fits : 0;
}

Plot coverage_plot(const CoverageResult& coverage) {
  Plot plot;
  PlotSeries bars{"", PlotSeries::Style::kPoints, {}};
  for (std::size_t i = 0; i < coverage.parameters.size(); ++i) {
    const ParameterCoverage& c = coverage.parameters[i];
    const double half =
        CalibrationEstimate::kNormal95 * std::sqrt(share_of(c) * (1 - share_of(c)) / std::max(1, c.fits));
    bars.points.push_back({.x = static_cast<double>(i + 1),
                           .y = share_of(c),
                           .y_low = share_of(c) - half,
                           .y_high = share_of(c) + half,
                           .label = traits_of(c.parameter).symbol});
  }
  const double end = static_cast<double>(coverage.parameters.size()) + 1;
  plot.series = {std::move(bars), {"stated", PlotSeries::Style::kLines, {{0.5, kStated}, {end, kStated}}}};
  plot.x = {.title = "Parameter", .minimum = 0.5, .maximum = end};
  plot.y = {.title = "Share of intervals that hold the truth", .minimum = 0.9, .maximum = 1};
  plot.key = KeyPosition::kBottomRight;
  return plot;
}

/// RMS error of the lens distance in micrometres.
double distance_error_um(const CoverageResult& coverage) {
  for (const ParameterCoverage& c : coverage.parameters)
    if (c.parameter == CalibrationParameter::kLensDistance) return c.rms_error * 1000;
  return 0;
}

ReportTable outlier_table(const std::vector<OutlierRun>& runs, ResultTable& rows) {
  ReportTable table{
      "One reading in ten off by 20 standard deviations: error of d_l by what the fit does about it",
      {"loss", "outliers", "RMS error of d_l [µm]", "coverage of d_l", "fits a second"},
      {},
      3};
  for (const OutlierRun& run : runs) {
    double coverage = 0;
    for (const ParameterCoverage& c : run.result.parameters)
      if (c.parameter == CalibrationParameter::kLensDistance) coverage = share_of(c);
    const double rate = run.result.rigs / run.result.seconds;
    table.rows.push_back({std::string(run.loss), run.share, distance_error_um(run.result), coverage, rate});
    rows.add({"rms_error_um",
              distance_error_um(run.result),
              "µm",
              {{"loss", std::string(run.loss)}, {"outliers", run.share}}});
    rows.add({"coverage_d_l", coverage, "1", {{"loss", std::string(run.loss)}, {"outliers", run.share}}});
    rows.add({"fits_per_second", rate, "1/s", {{"loss", std::string(run.loss)}, {"outliers", run.share}}});
  }
  return table;
}

}  // namespace

ReproductionResult reproduce_calibration_coverage(Laboratory& laboratory) {
  ReproductionResult result;
  const bool tiny = laboratory.options().effort == Effort::kTiny;
  const int rigs = tiny ? 100 : 1000, few = tiny ? 30 : 200;
  const CoverageResult coverage = cover(laboratory, full_rig(), 0, CalibrationLoss::kHuber, rigs);
  result.rows = coverage_rows(coverage);
  std::vector<OutlierRun> runs;
  for (const double share : {0.0, 0.1}) {
    runs.push_back({"none", share, cover(laboratory, anchored_rig(), share, CalibrationLoss::kNone, few)});
    runs.push_back({"Huber", share, cover(laboratory, anchored_rig(), share, CalibrationLoss::kHuber, few)});
    runs.push_back(
        {"Cauchy", share, cover(laboratory, anchored_rig(), share, CalibrationLoss::kCauchy, few)});
  }
  const auto [low, high] =
      std::minmax_element(coverage.parameters.begin(), coverage.parameters.end(),
                          [](const auto& a, const auto& b) { return share_of(a) < share_of(b); });
  result.paper_shows = "The thesis gives its calibration without uncertainties.";
  result.ours_shows = fmt::format(
      "Over {} simulated displays, each measured and fitted anew, the 95 % intervals of {} parameters hold "
      "the truth in {:.1f} % ({}) to {:.1f} % ({}) of cases; {} of {} fits converged, {:.1f} ms each. With "
      "one reading in ten off by 20 deviations the error of d_l is {} µm by least squares, {} µm with "
      "Huber's loss and {} µm with Cauchy's.",
      coverage.rigs, coverage.parameters.size(), 100 * share_of(*low), traits_of(low->parameter).symbol,
      100 * share_of(*high), traits_of(high->parameter).symbol, coverage.converged, coverage.rigs,
      1000 * coverage.seconds / coverage.rigs, format_number(distance_error_um(runs[3].result), 3),
      format_number(distance_error_um(runs[4].result), 3),
      format_number(distance_error_um(runs[5].result), 3));
  const double three = 3 * std::sqrt(kStated * (1 - kStated) / coverage.rigs);
  const bool sound = share_of(*low) > kStated - three && share_of(*high) < kStated + three;
  result.differs =
      sound ? "All shares lie within three standard deviations of 95 %: the intervals mean what they say."
            : "Some shares lie more than three standard deviations from 95 %: those intervals are not to be "
              "taken at their word.";
  const WideDesign design = coverage_design();
  result.add_table(wide_table(result.rows, design.keys, design.columns,
                              "Coverage of 95 % intervals over simulated displays, Huber's loss"));
  result.add_plot("coverage",
                  {coverage_plot(coverage),
                   "Share of 95 % intervals that hold the truth, with 95 % intervals of that share",
                   "Points with bars about 0.95."});
  result.add_table(outlier_table(runs, result.rows));
  return result;
}

}  // namespace plenolab
