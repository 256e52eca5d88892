#pragma once

#include <string>
#include <vector>

#include "analysis/calibration/conflict.h"
#include "analysis/calibration/coverage.h"
#include "analysis/result_table.h"
#include "experiments/cli/wide_table.h"

namespace plenolab {

/// Rows of a fit. Columns: parameter, role (fixed, anchored, free, derived), record (from 0, its place in the
/// file's "records"), kind, reading.
///   estimate, sd, interval_low, interval_high   of what is determined; nominal and determined (0 or 1) of
///   all correlation (columns parameter, other) unknowns, rank, condition_number, chi2, degrees_of_freedom,
///   p_value (absent without degrees of freedom), iterations, starts, starts_agreeing, singular_value (column
///   number) measured, predicted, deviations, weight, outlier (0 or 1) of every reading and anchor
ResultTable calibration_rows(const CalibrationMeasurements& measurements, const CalibrationFit& fit);

/// Rows of plain least-squares fits without each source (column without): chi2, degrees_of_freedom, p_value,
/// estimates, and left_out_measured, left_out_predicted.
ResultTable doubt_rows(const std::vector<DoubtedSource>& doubts);

/// Rows of coverage (column parameter): coverage with its 95 % Wilson interval (coverage_low, coverage_high),
/// rms_error, mean_error, mean_sd, fits.
ResultTable coverage_rows(const CoverageResult& coverage);

/// What people read of these rows, as keys and columns of a wide table.
struct WideDesign {
  std::vector<std::string> keys;
  std::vector<WideColumn> columns;
};
WideDesign estimate_design();
WideDesign reading_design();
WideDesign doubt_design(const std::vector<DoubtedSource>& doubts);
WideDesign coverage_design();

/// What the fit says in sentences: whether it converged, fits and determines everything, what cannot be told
/// apart, which readings are outliers.
std::vector<std::string> calibration_sentences(const CalibrationFit& fit);

/// What would reconcile readings that contradict each other, in sentences.
std::vector<std::string> doubt_sentences(const std::vector<DoubtedSource>& doubts);

}  // namespace plenolab
