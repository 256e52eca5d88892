#pragma once

#include "analysis/calibration/measurements.h"

namespace plenolab {

/// The fit that first comes to mind, for comparison: d_l and f themselves as unknowns, and the distance of
/// the virtual image, d_l·f/(f − d_l), in millimetres as the reading. It diverges at d_l = f.
struct NaiveFocusFit {
  double lens_distance_mm = 0, focal_length_mm = 0;
  int iterations = 0;
  bool converged = false;
};

/// Readings: a field of view and an image distance with the deviation of the same reading in dioptres.
NaiveFocusFit fit_naive_focus(const FieldOfViewRecord& angle, const FocusRecord& focus, double subimage_mm,
                              double start_lens_distance_mm, double start_focal_length_mm,
                              int max_iterations);

}  // namespace plenolab
