#pragma once

#include "experiments/near_eye.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// The light field of a scene for the near-eye display, made in each way: two steps and one, four and five
/// cameras, supersampling 1, 2 and 4, and every camera rendered. Errors are against every camera rendered
/// with supersampling 4, on the display's subimages, values in [0, 1]. Times include rendering of the
/// cameras, and down-sampling. Rows with columns scene, method (two-step, one-step, direct), cameras,
/// supersampling: mean_error, hole_share, and those of add_outcome_rows.
ResultTable sweep_reprojection(const Scene& scene, const SweepRun& run);
SweepPlotDesign reprojection_sweep_plot();

}  // namespace plenolab
