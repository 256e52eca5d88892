#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/result_table.h"
#include "core/base/progress.h"
#include "core/lightfield/light_field.h"
#include "core/tonemap/filters/bilateral_grid.h"
#include "experiments/cli/operator_options.h"
#include "experiments/sweep_outcome.h"

namespace plenolab {

/// An image that a sweep works on.
struct SweepImage {
  std::string name;
  OperatorView view;  ///< disparity may be missing
};

/// How a sweep runs.
struct SweepRun {
  int runs = 3;  ///< timed runs of every setting, ≥ 1
  int threads = 0;
  std::uint64_t seed = 1;  ///< of sweeps whose result is random
  Progress progress;
};

/// Samplings of the bilateral grid that are swept.
std::vector<GridSampling> all_grid_samplings();

/// The bilateral filter of the operator's default widths on log luminance: the grid with each sampling, and
/// the exact filter, against which errors are. With disparity also the filter of the enhanced operator. Rows
/// with columns image, filter (naive or enhanced), method (grid or exact), per_sigma_s, per_sigma_value,
/// per_sigma_d: rms_error and max_error of the base layer (log10 units), and those of add_outcome_rows.
/// Samplings that the image is too small for are left out.
ResultTable sweep_bilateral(const SweepImage& image, const std::vector<GridSampling>& samplings,
                            const SweepRun& run);
SweepPlotDesign bilateral_sweep_plot();

/// Numbers of bins that are swept.
std::vector<int> all_bin_numbers();

/// Histogram adjustment with each number of bins: its luma against that with the largest number allowed.
/// Rows with columns image, bins: rms_error and max_error (luma), trimming_passes, and those of
/// add_outcome_rows for histogram, fit and mapping together.
ResultTable sweep_histogram(const SweepImage& image, const std::vector<int>& bins, const SweepRun& run);
SweepPlotDesign histogram_sweep_plot();

/// Settings of key-view adjustment that are swept.
struct AdjustmentSetting {
  double sigma_views = 2;
  double support_views = 6;
};
std::vector<AdjustmentSetting> all_adjustment_settings(const ViewGrid& grid);

/// Key-view adjustment with each setting: channel values against those with the same sigma_views and support
/// over the whole grid. Rows with columns light_field, sigma_views, support_views: rms_error and max_error,
/// neighbour_difference (mean absolute difference in luma of corresponding pixels of neighbouring views) and
/// neighbour_difference_before, correspondences_per_pixel, and those of add_outcome_rows.
ResultTable sweep_adjustment(const LightField& field, const std::string& name, const OperatorChoice& choice,
                             const std::vector<AdjustmentSetting>& settings, const SweepRun& run);
SweepPlotDesign adjustment_sweep_plot();

}  // namespace plenolab
