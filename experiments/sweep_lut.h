#pragma once

#include <string>

#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// Tables of 8 to 64 nodes along an axis, trilinear and tetrahedral, in place of what they hold: a smooth
/// chain of colour correction (grade_chain.h) and a colour transfer from a painted palette to the picture.
/// Errors are ΔE*ab against the chain evaluated for every pixel, times those of grading by the prepared
/// table. Rows with columns picture, chain ("correction", "transfer"), interpolation, size: mean_delta_e,
/// largest_delta_e, and those of add_outcome_rows; and with interpolation "none" the chain itself. The Pareto
/// front is that of a chain.
ResultTable sweep_lut(const std::string& name, const DisplayImage& picture, const SweepRun& run);
/// Error over the size of the table, a line for each chain and interpolation; time hardly depends on the
/// size. Settings without error are left out: no series if a picture is graded exactly, as a black one is.
Plot plot_lut_sweep(const ResultTable& rows);

/// Counting every n-th pixel of every n-th row of five frames of the walk (experiments/walk.h) of 1920 × 1080
/// pixels, one after the other. Errors are those of the graded frames against counting every pixel. Rows with
/// columns picture, chain ("pixel counting"), divisor: mean_delta_e (mean of the frames), largest_delta_e (of
/// a frame's mean), largest_weight_error, and those of add_outcome_rows, times a frame.
ResultTable sweep_pixel_counting(const SweepRun& run);
SweepPlotDesign pixel_counting_sweep_plot();

}  // namespace plenolab
