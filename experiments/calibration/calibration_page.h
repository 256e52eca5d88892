#pragma once

#include <string>
#include <vector>

#include "analysis/calibration/conflict.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// Whitened residuals of all readings, by kind.
ReportPlot residual_plot(const CalibrationFit& fit);

/// Predicted against measured readings of one kind, with the line of equality. Empty series if the kind does
/// not occur.
ReportPlot agreement_plot(const CalibrationFit& fit, const std::string& kind, const std::string& reading);

/// The strongest correlations between parameters; no series if fewer than two are determined.
ReportPlot correlation_plot(const CalibrationFit& fit);

/// Standard deviation along every direction of the parameter space, from best to least determined, and the
/// limit above which nothing is called determined.
ReportPlot direction_plot(const CalibrationFit& fit);

/// How parameters move together along the open directions; no series if there are none.
ReportPlot open_direction_plot(const CalibrationFit& fit);

/// A fit as sections of a report with their plots under names for files.
struct CalibrationPage {
  Report report;
  std::vector<NamedPlot> plots;
};

/// The page of `plenolab calibrate -o`: sentences, estimates, plots, readings, and what would reconcile
/// readings that contradict each other (`doubts`, empty if they do not).
CalibrationPage calibration_page(const std::string& title, const CalibrationMeasurements& measurements,
                                 const CalibrationFit& fit, const std::vector<DoubtedSource>& doubts,
                                 const Provenance& provenance);

}  // namespace plenolab
