#include "experiments/sweep_methods.h"
#include "experiments/sweep_stimuli.h"

namespace plenolab {

namespace {

/// The columns of a tone mapping sweep: errors, what is special to it, time and memory.
std::vector<WideColumn> tone_columns(const std::vector<WideColumn>& special) {
  std::vector<WideColumn> columns{{"rms_error", "RMS error"}, {"max_error", "largest error"}};
  columns.insert(columns.end(), special.begin(), special.end());
  for (const WideColumn& column : {WideColumn{"seconds_median", "seconds"},
                                   {"memory_peak_mib", "peak [MiB]"},
                                   {"on_pareto_front", "Pareto front"}})
    columns.push_back(column);
  return columns;
}

}  // namespace

const std::vector<SweepMethod>& sweep_methods() {
  static const std::vector<SweepMethod> table{
      {"synthesis",
       run_synthesis_sweep,
       {"scene", "width", "search", "key_views", "step_px"},
       sweep_columns()},
      {"bilateral",
       run_bilateral_sweep,
       {"image", "filter", "method", "per_sigma_s", "per_sigma_value", "per_sigma_d"},
       tone_columns({})},
      {"histogram", run_histogram_sweep, {"image", "bins"}, tone_columns({{"trimming_passes", "passes"}})},
      {"adjustment",
       run_adjustment_sweep,
       {"light_field", "sigma_views", "support_views"},
       tone_columns({{"neighbour_difference", "between neighbours"},
                     {"correspondences_per_pixel", "correspondences"}})},
      {"drim",
       run_drim_sweep,
       {"image", "divisor", "orientations"},
       {{"mean_error", "mean error"},
        {"rms_error", "RMS error"},
        {"drim_share_any", "distorted"},
        {"seconds_median", "seconds"},
        {"memory_peak_mib", "peak [MiB]"},
        {"on_pareto_front", "Pareto front"}}},
      {"optimise",
       run_optimise_sweep,
       {"image", "shrink", "children", "iterations"},
       {{"objective", "feature_content_adaptive"},
        {"objective_best", "best seed"},
        {"objective_worst", "worst seed"},
        {"objective_excess", "above the best"},
        {"evaluations", "images judged"},
        {"seconds_median", "seconds"},
        {"memory_peak_mib", "peak [MiB]"},
        {"on_pareto_front", "Pareto front"}}},
      {"reprojection",
       run_reprojection_sweep,
       {"scene", "method", "cameras", "supersampling"},
       {{"mean_error", "mean error"},
        {"hole_share", "holes"},
        {"seconds_median", "seconds"},
        {"memory_peak_mib", "peak [MiB]"},
        {"on_pareto_front", "Pareto front"}}},
      {"luminance",
       run_luminance_sweep,
       {"scene", "method", "pinhole", "samples"},
       {{"rms_error", "RMS of ln, to brute force"},
        {"max_error", "largest"},
        {"on_pareto_front", "front"},
        {"rms_error_to_scene", "RMS of ln, to the scene"},
        {"on_pareto_front_to_scene", "front there"},
        {"seconds_median", "seconds"},
        {"memory_peak_mib", "peak [MiB]"}}},
      {"lut",
       run_lut_sweep,
       {"picture", "chain", "interpolation", "size", "divisor"},
       {{"mean_delta_e", "mean ΔE"},
        {"largest_delta_e", "largest ΔE"},
        {"largest_weight_error", "weight error"},
        {"seconds_median", "seconds"},
        {"memory_peak_mib", "peak [MiB]"},
        {"on_pareto_front", "Pareto front"}}},
  };
  return table;
}

}  // namespace plenolab
