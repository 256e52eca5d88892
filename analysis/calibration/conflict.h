#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/calibration/fit.h"

namespace plenolab {

/// A fit without one of its sources: the readings of a kind, or the anchor of a parameter, are left out, and
/// the rest says what they should have been.
struct DoubtedSource {
  std::string source;  ///< "focus readings" or "the anchor of f"; "nothing" for the fit to everything
  CalibrationFit fit;
  /// What the fit predicts for that which was left out, against what was read, where it was farthest off.
  /// Absent for "nothing", and where the rest does not determine it.
  struct LeftOut {
    std::string what;  ///< "vergence_dpt", "f_mm"
    double measured = 0, predicted = 0, deviations = 0;
  };
  std::optional<LeftOut> left_out;
};

/// Measurements contradict each other if a χ² this large is rarer than this.
inline constexpr double kContradiction = 0.01;
inline bool contradicts(const CalibrationFit& fit) {
  return fit.p_value < kContradiction;
}

/// The fit to everything, then without each source in turn. One that reconciles the rest is not thereby
/// wrong: it says what would have to be, so that it can be checked.
std::vector<DoubtedSource> doubt_each_source(const CalibrationMeasurements& measurements,
                                             const CalibrationFitOptions& options = {});

}  // namespace plenolab
