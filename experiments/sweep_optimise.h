#pragma once

#include <string>
#include <vector>

#include "experiments/optimise/objective.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// How the generic operator is optimised in a sweep.
struct OptimiseSetting {
  int shrink = 1;       ///< the search sees the image averaged down by this, [1, 64]
  int children = 10;    ///< λ
  int iterations = 20;  ///< at most
};
std::vector<OptimiseSetting> all_optimise_settings();

/// The generic operator optimised for one image with each setting. Rows with columns image, shrink, children,
/// iterations, search ("children × iterations"): objective (the quantity at full size, the median of run.runs
/// searches with the seeds run.seed, run.seed + 1, …), objective_best and objective_worst of these,
/// objective_excess (by how much the median is worse than the best one of all settings), evaluations
/// (median), and those of add_outcome_rows for a whole search. `quantity` is one of objective_quantities().
/// Throws InputError for another.
ResultTable sweep_optimise(const SweepImage& image, double cd_m2_per_unit, const std::string& quantity,
                           const std::vector<OptimiseSetting>& settings, const SweepRun& run);
SweepPlotDesign optimise_sweep_plot(const Objective& objective);

}  // namespace plenolab
