#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/calibration/coordinates.h"
#include "analysis/calibration/uncertainty.h"

namespace plenolab {

/// The directions that a whitened Jacobian leaves open, named in words: those beyond its rank, rid of every
/// parameter that they can do without, then those along which the standard deviation is above kKnownWithin.
/// `fitted` are the parameters of the columns; `singular` and `right` come from its decomposition; `derived`
/// says which combinations are determined.
std::vector<OpenDirection> open_directions(const CalibrationCoordinates& coordinates,
                                           const DisplayGeometry<CalibrationJet>& geometry,
                                           const std::vector<Eigen::Index>& fitted,
                                           const Eigen::VectorXd& singular, const Eigen::MatrixXd& right,
                                           int rank, const std::vector<CalibrationEstimate>& derived);

}  // namespace plenolab
