#pragma once

#include "analysis/calibration/simulate.h"

namespace plenolab {

/// Set-ups as in the appendices of Hansen & Klein 2016, for examples, reproductions and tests. The thesis
/// prints no readings; heights, numbers of readings and deviations are ours.

/// Appendix B alone: lens centres on the pixel grid under a microscope. Lens pitch, offset and rotation are
/// asked; the pixel pitch is taken from the data sheet (12 µm, ± 0.01 µm).
CalibrationRig grid_rig();

/// Figures C.1 and C.2 with focus readings and a grid, all four lengths (p, w_l, d_l, f) free and nothing
/// anchored: one length has to be known before any other can be (rank 3 of 4).
CalibrationRig unanchored_rig();

/// The same lengths with the pixel pitch anchored: nothing else asked, nothing else measured.
CalibrationRig anchored_rig();

/// Everything the appendices measure: edges at two heights, targets on the axis and oblique at several
/// depths, focus, grid and sharpness; every parameter fitted, the pixel pitch anchored.
CalibrationRig full_rig();

/// The rig of figures C.3 and C.4: one target straight ahead and one oblique, moved from near to far.
/// `true_fov_deg` is that of the display; virtual cameras have the instrument's.
CalibrationRig target_rig(double true_fov_deg);

/// The thesis' own figures as measurements: the angle 19.86° (one number is printed, and so it is one
/// reading), the panel seen sharp as if 965 mm away, subimages of 80⅓ instead of 83⅓ px sharpest, and anchors
/// at the nominal lengths: six numbers for four unknowns. They contradict each other.
CalibrationMeasurements thesis_measurements();

}  // namespace plenolab
