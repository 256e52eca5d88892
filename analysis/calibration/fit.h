#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/calibration/measurements.h"
#include "analysis/calibration/model.h"
#include "analysis/calibration/uncertainty.h"

namespace plenolab {

/// What a residual r (in standard deviations) costs: r² for kNone; Huber (1964) beyond the scale k only
/// linearly; Cauchy k²·log(1 + r²/k²), by which far outliers lose all pull.
enum class CalibrationLoss { kNone, kHuber, kCauchy };

struct CalibrationFitOptions {
  CalibrationLoss loss = CalibrationLoss::kHuber;
  /// In standard deviations, > 0; 0 stands for 95 % efficiency on normal errors: 1.345 (Huber), 2.385
  /// (Cauchy).
  double loss_scale = 0;
  int starts = 6;                 ///< ≥ 1: the nominal values, then places around them
  int max_iterations = 200;       ///< ≥ 1, of each start
  double outlier_deviations = 4;  ///< > 0: readings farther off are named as outliers
  std::uint64_t seed = 1;         ///< of the further starts

  /// Throws InputError naming the value out of range.
  void validate() const;
  double scale() const;  ///< loss_scale, or the one it stands for
};

/// One reading, or anchor, against the fit.
struct FittedReading {
  std::size_t record = 0;  ///< its number in the file; of an anchor: that of the parameter
  std::string kind;        ///< of the record, or "anchor"
  std::string what;        ///< "displacement_mm", "x_px"; of an anchor: the parameter
  double measured = 0, predicted = 0, sd = 0;
  double deviations = 0;  ///< (predicted − measured)/sd
  double weight = 1;      ///< that the loss leaves it, in [0, 1]
  bool outlier = false;
};

/// The result of a fit.
struct CalibrationFit {
  CalibrationLoss loss = CalibrationLoss::kNone;  ///< that it was fitted with
  bool converged = false;
  std::string message;  ///< of the solver, where it did not converge
  ParameterValues values{};
  DisplayGeometry<double> geometry;  ///< the same, with the vergence
  CalibrationUncertainty uncertainty;
  std::vector<FittedReading> readings;  ///< readings in the order of the file, then anchors
  double chi2 = 0;                      ///< Σ deviations², outliers included
  int degrees_of_freedom = 0;           ///< readings + anchors − rank
  /// Of a χ² as large or larger if the model and the deviations hold; absent without degrees of freedom,
  /// where nothing is left to test. Exact for plain least squares; a robust loss leaves a larger χ².
  std::optional<double> p_value;
  int iterations = 0;       ///< of the best start
  int starts = 0;           ///< that were tried
  int starts_agreeing = 0;  ///< that ended at the same cost as the best
};

/// Fits the parameters that are not fixed: whitened residuals, exact derivatives, Levenberg–Marquardt (Ceres)
/// from several starts in coordinates that stay smooth as d_l → f (coordinates.h). A solver that fails is a
/// result (`converged`), not an error. Throws InputError for measurements or options that are not valid.
CalibrationFit fit_calibration(const CalibrationMeasurements& measurements,
                               const CalibrationFitOptions& options = {});

}  // namespace plenolab
