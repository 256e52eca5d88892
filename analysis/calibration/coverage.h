#pragma once

#include <cstdint>
#include <vector>

#include "analysis/calibration/fit.h"
#include "analysis/calibration/simulate.h"

namespace plenolab {

/// How often intervals hold the truth, over simulated instruments.
struct CoverageOptions {
  int rigs = 1000;  ///< ≥ 1
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = all cores
  CalibrationFitOptions fit{.starts = 1};

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// One parameter over all rigs whose fit converged and determined it.
struct ParameterCoverage {
  CalibrationParameter parameter{};
  int fits = 0;                          ///< that determined it
  int covered = 0;                       ///< of them, with the truth inside the 95 % interval
  double rms_error = 0, mean_error = 0;  ///< estimate − truth, in the parameter's unit
  double mean_sd = 0;                    ///< that the fits reported
};

struct CoverageResult {
  int rigs = 0, converged = 0;
  std::vector<ParameterCoverage> parameters;  ///< those that are not fixed
  double seconds = 0;
};

/// Simulates and fits `rigs` instruments; the same for any number of threads.
CoverageResult measure_coverage(const CalibrationRig& rig, const CoverageOptions& options = {});

}  // namespace plenolab
