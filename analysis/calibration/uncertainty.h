#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/calibration/measurements.h"
#include "analysis/calibration/model.h"

namespace plenolab {

/// A number with its standard deviation; without one where the data do not determine it.
struct CalibrationEstimate {
  std::string name, symbol, unit, meaning;
  double value = 0;  ///< means nothing unless it is determined or fixed
  /// 0 for what is fixed; absent where the data do not determine the number: no deviation at all, or one
  /// above kKnownWithin of its own size, is never shown as if it were an estimate.
  std::optional<double> sd;

  bool determined() const { return sd.has_value(); }
  /// 95 % interval, value ± 1.96 sd.
  double low() const { return value - kNormal95 * sd.value_or(0); }
  double high() const { return value + kNormal95 * sd.value_or(0); }

  static constexpr double kNormal95 = 1.959963984540054;
};

/// Numbers with a larger standard deviation than this share of their size count as not determined: an
/// interval of ± half the length says that it was not measured, and the linear theory behind it no longer
/// holds. The size is that of the number itself, and where that may be about 0 a useful one: the unit of its
/// coordinate for offsets, rotation and pupil (coordinates.h), kUsefulVergence_dpt for the vergence, and
/// d_l²·1 dpt, the same as a length, for f − d_l.
inline constexpr double kKnownWithin = 0.25;
/// A quarter of it is the step in which spectacle lenses are made: what an eye notices.
inline constexpr double kUsefulVergence_dpt = 1;

/// A direction in which the parameters may move together while the predictions stay (nearly) as they are.
struct OpenDirection {
  ParameterValues change{};  ///< relative for positive parameters, else in their unit; largest relative 1 %
  bool exact = true;         ///< no prediction changes at all; otherwise the data merely are too weak
  std::string sentence;      ///< "d_l and w_l cannot be told apart: …"
};

/// What the data determine, at one geometry.
struct CalibrationUncertainty {
  std::vector<CalibrationEstimate> parameters;  ///< all of them, fixed ones included, in their order
  std::vector<CalibrationEstimate> derived;     ///< derived_quantities(), in their order
  /// Correlations of the parameters, by index; empty where either is fixed or not determined.
  std::vector<std::vector<std::optional<double>>> correlation;
  int unknowns = 0;                        ///< parameters that are not fixed
  int rank = 0;                            ///< of the whitened Jacobian (readings and anchors)
  std::vector<double> singular_values;     ///< of it, largest first, in coordinates of order one
  std::optional<double> condition_number;  ///< absent where the rank is less than the unknowns
  std::vector<OpenDirection> open;         ///< exact ones first
};

/// How the loss weighs the readings in the covariance (1 and 1 for plain least squares): for an M-estimator
/// with influence ψ, the means of ψ′ and of ψ² over the readings (Huber 1981, section 7.6).
struct LossMoments {
  double mean_slope = 1, mean_square = 1;
};

/// Derivatives of the whitened residuals by all coordinates, rows as residuals_of().
Eigen::MatrixXd whitened_jacobian(const CalibrationMeasurements& measurements, const ParameterValues& x);

/// Rank, open directions, estimates with deviations, correlations at the coordinates `x`.
CalibrationUncertainty uncertainty_at(const CalibrationMeasurements& measurements, const ParameterValues& x,
                                      const LossMoments& moments = {});

}  // namespace plenolab
