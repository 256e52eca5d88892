#pragma once

#include "experiments/luminance_field.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// The luminance of what a display shows, estimated in each way: brute force with pinhole images of several
/// sizes, accumulation plain, smoothed and spread with and without normalised weights; each with 10 to 10000
/// samples along the observers' line. Errors are those of ln L̄, between samples interpolated, against two
/// truths: brute force at the display's resolution with 10000 samples (the light of the display itself), and
/// the pinhole pictures of the scene, if there is one. Rows with columns scene, method, pinhole (WxH; empty
/// but for brute force), samples: rms_error, max_error and on_pareto_front (against brute force; none of the
/// setting that is this reference), rms_error_to_scene and on_pareto_front_to_scene, undefined_samples,
/// seconds_median …, memory_peak_mib.
ResultTable sweep_luminance(const ShownField& field, const SweepRun& run);

/// Which truth a plot of errors is about.
enum class LuminanceTruth { kBruteForce, kScene };

/// Error over run time, Pareto-optimal settings ringed, labels = samples where there is room for them. No
/// series if there are no such errors.
Plot plot_luminance_sweep(const ResultTable& rows, LuminanceTruth truth);

}  // namespace plenolab
