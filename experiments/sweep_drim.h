#pragma once

#include <vector>

#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// How DRIM is computed in a sweep: on images averaged down by `divisor`, whose pixels per degree fall with
/// it, in fewer orientations; the lowest band stays at the same cycles per degree.
struct DrimSetting {
  int divisor = 1;       ///< 1, 2 or 4
  int orientations = 6;  ///< [1, 24]
};
std::vector<DrimSetting> all_drim_settings();

/// DRIM of the image, tone mapped by `choice` and shown on the default display, against itself in cd/m². Each
/// setting's maps, spread to full size, against those of divisor 1 and 6 orientations. Rows with columns
/// image, divisor, orientations: mean_error and rms_error (of probabilities, over the three maps),
/// drim_share_any, drim_mean_total, and those of add_outcome_rows.
ResultTable sweep_drim(const SweepImage& image, double cd_m2_per_unit, const OperatorChoice& choice,
                       const std::vector<DrimSetting>& settings, const SweepRun& run);
SweepPlotDesign drim_sweep_plot();

}  // namespace plenolab
