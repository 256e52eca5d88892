#pragma once

#include <cstdint>
#include <string>

#include "analysis/calibration/measurements.h"

namespace plenolab {

/// A simulated instrument: what is true, what is measured, and how well.
struct CalibrationRig {
  CalibrationMeasurements plan;  ///< its readings are ignored
  ParameterValues truth = nominal_values();
  double outlier_share = 0;       ///< of the readings, in [0, 1]
  double outlier_deviations = 0;  ///< how far off they are, in standard deviations, either way

  /// As CalibrationMeasurements::validate, and: true values finite, positive where they must be; a share in
  /// [0, 1]. The truth of a fixed parameter may differ from its nominal value: that is how a false belief is
  /// simulated.
  void validate(const std::string& name) const;
};

/// The measurements that the rig yields: readings of the forward model with normal noise, outliers if asked
/// for. Nominal values of anchored parameters are drawn about the truth, since an anchor is a reading too;
/// those of free parameters stay, as where the search begins. Every draw is a hash of (seed, its place).
CalibrationMeasurements simulate_measurements(const CalibrationRig& rig, std::uint64_t seed);

/// What the instrument would read without noise.
CalibrationMeasurements exact_measurements(const CalibrationRig& rig);

}  // namespace plenolab
