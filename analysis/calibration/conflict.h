#pragma once

#include <string>
#include <vector>

#include "analysis/calibration/fit.h"

namespace plenolab {

/// What a fit predicts for a reading, or an anchor, that it was not given.
struct LeftOutReading {
  std::string what;  ///< "vergence_dpt", "f_mm"
  double measured = 0, predicted = 0;
  double deviations = 0;  ///< 0 for a fixed value, which has no deviation
};

/// A fit without some of its sources: the readings of a kind, the anchor of a parameter, or the value at
/// which a parameter is fixed.
struct DoubtedSource {
  /// "focus", "anchor of f", "fixed value of p", two of them with " + "; "nothing" for none.
  std::string source;
  CalibrationFit fit;
  /// Of each source left out the reading that the rest contradicts most; empty for "nothing", and where the
  /// rest does not determine everything.
  std::vector<LeftOutReading> left_out;
};

/// Measurements contradict each other if a χ² this large is rarer than this. Without degrees of freedom
/// nothing can be contradicted, and nothing agrees.
inline constexpr double kContradiction = 0.01;
inline bool contradicts(const CalibrationFit& fit) {
  return fit.p_value && *fit.p_value < kContradiction;
}

/// Whether a contradiction is that of a few outliers: at most one reading in five, and without them the rest
/// agrees.
bool isolated_outliers(const CalibrationFit& fit);

/// Plain least-squares fits to everything ("nothing" left out), then without each source in turn (fixed
/// values only where the readings determine the parameter instead); if none of these reconciles the rest,
/// also without any two, of which only those are given that reconcile it with readings to spare. A source
/// that reconciles the rest is not thereby wrong: it says what would have to be, so that it can be checked.
std::vector<DoubtedSource> doubt_each_source(const CalibrationMeasurements& measurements,
                                             CalibrationFitOptions options = {});

}  // namespace plenolab
