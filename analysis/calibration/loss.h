#pragma once

#include <span>

#include "analysis/calibration/fit.h"

namespace plenolab {

/// Influence ψ of a residual under a loss, and its slope (Huber 1981, chapter 3).
double influence(const CalibrationFitOptions& options, double deviations);
double influence_slope(const CalibrationFitOptions& options, double deviations);

/// Weight that the loss leaves a reading, ψ(r)/r, 1 at 0.
double loss_weight(const CalibrationFitOptions& options, double deviations);

/// Means of ψ′ and ψ² for the covariance: those of normal errors for the readings that are not outliers
/// (beyond outlier_deviations), and what they came to for those that are. Taken over few readings, empirical
/// means alone would be too uncertain.
LossMoments loss_moments(const CalibrationFitOptions& options, std::span<const double> deviations);

}  // namespace plenolab
