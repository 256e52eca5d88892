#pragma once

#include "experiments/luminance_field.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// The luminance of what a display shows, estimated in each way: brute force with pinhole images of several
/// sizes, accumulation plain, smoothed and spread with and without normalised weights; each with 10 to 10000
/// samples along the observers' line. Errors are those of ln L̄, between samples interpolated, against brute
/// force at the display's resolution with 10000 samples. Rows with columns scene, method, pinhole (WxH; empty
/// but for brute force), samples: rms_error, max_error (of ln L̄), undefined_samples, and those of
/// add_outcome_rows.
ResultTable sweep_luminance(const ShownField& field, const SweepRun& run);
SweepPlotDesign luminance_sweep_plot();

}  // namespace plenolab
