#include "experiments/sweep_methods.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "experiments/cli/display_options.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/scenes.h"
#include "experiments/cli/viewing_options.h"
#include "experiments/sweep_drim.h"
#include "experiments/sweep_luminance.h"
#include "experiments/sweep_lut.h"
#include "experiments/sweep_optimise.h"
#include "experiments/sweep_reprojection.h"
#include "experiments/sweep_stimuli.h"
#include "experiments/sweep_synthesis.h"
#include "experiments/sweep_tonemap.h"
#include "experiments/tonemap_fit.h"
#include "experiments/walk.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

SceneStimulusOptions stimulus_options(const SweepOptions& options) {
  return {.cache = render_cache_folder(options.cache),
          .seed = options.common.seed,
          .threads = options.common.threads};
}

std::vector<SweepStimulus> stimuli_of(const SweepOptions& options) {
  if (source_exists(options)) return {stimulus_from_captured(open_radiance(options.source))};
  return stimuli_from_scene(scene_named(options.source).id, stimulus_options(options));
}

SweepImage image_of(const SweepOptions& options) {
  if (source_exists(options)) return image_from_file(options.source);
  return image_from_scene(scene_named(options.source).id, stimulus_options(options));
}

LightField field_of(const SweepOptions& options) {
  if (source_exists(options)) return open_radiance(options.source);
  return field_from_scene(scene_named(options.source).id, stimulus_options(options));
}

SweepRun run_of(const SweepOptions& options, ProgressBar& bar) {
  return {.runs = options.runs,
          .threads = options.common.threads,
          .seed = options.common.seed,
          .progress = bar.callback()};
}

void write_sweep_plot(const ResultTable& table, const SweepPlotDesign& design, const std::string& name,
                      const fs::path& folder) {
  const Plot plot = plot_sweep(table, design);
  if (!plot.series.empty())
    write_plot(plot, folder / fmt::format("sweep-{}", fs::path(name).stem().string()));
}

constexpr const char* kObjective = "feature_content_adaptive";

constexpr const char* kWalk = "walk";

DisplayImage picture_of(const SweepOptions& options) {
  if (is_walk(options)) {
    const std::vector<WalkPose> path = walk_path();
    return WalkStage().frame(path[path.size() / 2], 960, 540, options.common.threads).picture;
  }
  if (is_display_file(options.source)) return read_display_image(options.source);
  const OperatorView view = image_of(options).view;
  return expose(*view.colour, exposure_from(*view.colour));
}

}  // namespace

bool source_exists(const SweepOptions& options) {
  if (fs::exists(options.source)) return true;
  if (fs::path(options.source).has_parent_path())
    throw InputError(fmt::format("{} does not exist", options.source));
  return false;
}

ResultTable run_synthesis_sweep(const SweepOptions& options, const fs::path& folder) {
  const std::vector<SweepStimulus> stimuli = stimuli_of(options);
  SynthesisSweepOptions sweep;
  sweep.runs = options.runs;
  sweep.threads = options.common.threads;
  ProgressBar bar("sweep");
  const ResultTable table = sweep_synthesis(stimuli, sweep, bar.callback());
  for (const SweepStimulus& s : stimuli) {
    const int width = s.key_views.grid().width;
    write_plot(plot_synthesis_sweep(table, s.name, width),
               folder / fmt::format("sweep-{}-{}px", s.name, width));
  }
  return table;
}

ResultTable run_bilateral_sweep(const SweepOptions& options, const fs::path& folder) {
  const SweepImage image = image_of(options);
  ProgressBar bar("sweep");
  const ResultTable table = sweep_bilateral(image, all_grid_samplings(), run_of(options, bar));
  write_sweep_plot(table, bilateral_sweep_plot(), image.name, folder);
  return table;
}

ResultTable run_histogram_sweep(const SweepOptions& options, const fs::path& folder) {
  const SweepImage image = image_of(options);
  ProgressBar bar("sweep");
  const ResultTable table = sweep_histogram(image, all_bin_numbers(), run_of(options, bar));
  write_sweep_plot(table, histogram_sweep_plot(), image.name, folder);
  return table;
}

/// Key-view adjustment is for operators that map views one by one: the photoreceptor one if none is named.
OperatorChoice adjusted_operator(const SweepOptions& options) {
  OperatorOptions chosen = options.chosen;
  if (chosen.name.empty()) chosen.name = "reinhard05";
  const OperatorChoice choice = choose_operator(chosen);
  require_view_variant(choice);
  return choice;
}

ResultTable run_adjustment_sweep(const SweepOptions& options, const fs::path& folder) {
  const OperatorChoice choice = adjusted_operator(options);
  const LightField field = field_of(options);
  const std::string name = fs::path(item_path(options.source)).filename().string();
  ProgressBar bar("sweep");
  const ResultTable table =
      sweep_adjustment(field, name, choice, all_adjustment_settings(field.grid()), run_of(options, bar));
  write_sweep_plot(table, adjustment_sweep_plot(), name, folder);
  return table;
}

ResultTable run_reprojection_sweep(const SweepOptions& options, const fs::path& folder) {
  if (source_exists(options)) throw UsageError("the sweep of reprojection renders its cameras: name a scene");
  const Scene scene = scene_named(options.source);
  ProgressBar bar("sweep");
  const ResultTable table = sweep_reprojection(scene, run_of(options, bar));
  write_sweep_plot(table, reprojection_sweep_plot(), scene.id, folder);
  return table;
}

/// The image that DRIM compares is tone mapped by the photographic operator if none is named.
OperatorChoice mapping_operator(const SweepOptions& options) {
  OperatorOptions chosen = options.chosen;
  if (chosen.name.empty()) chosen.name = "reinhard02";
  const OperatorChoice choice = choose_operator(chosen);
  require_view_variant(choice);
  return choice;
}

double luminance_scale_of(const SweepOptions& options) {
  if (!source_exists(options)) {
    if (options.cd_m2_per_unit > 0) throw UsageError("--cd-m2-per-unit is for files; scenes are in cd/m²");
    return 1;
  }
  const std::optional<double> scale = luminance_scale(options.cd_m2_per_unit, options.source);
  if (!scale) throw UsageError(scale_needed(options.method));
  return *scale;
}

ResultTable run_drim_sweep(const SweepOptions& options, const fs::path& folder) {
  const OperatorChoice choice = mapping_operator(options);
  const SweepImage image = image_of(options);
  const double cd_m2_per_unit = luminance_scale_of(options);
  ProgressBar bar("sweep");
  const ResultTable table =
      sweep_drim(image, cd_m2_per_unit, choice, all_drim_settings(), run_of(options, bar));
  write_sweep_plot(table, drim_sweep_plot(), image.name, folder);
  return table;
}

ResultTable run_optimise_sweep(const SweepOptions& options, const fs::path& folder) {
  const SweepImage image = image_of(options);
  const double cd_m2_per_unit = luminance_scale_of(options);
  ProgressBar bar("sweep");
  const ResultTable table =
      sweep_optimise(image, cd_m2_per_unit, kObjective, all_optimise_settings(), run_of(options, bar));
  write_sweep_plot(table, optimise_sweep_plot(describe_objective(kObjective)), image.name, folder);
  return table;
}

ResultTable run_luminance_sweep(const SweepOptions& options, const fs::path& folder) {
  require_field_source(options.source, {});
  const ShownField field = open_field(options.source, {}, {.threads = options.common.threads});
  ProgressBar bar("sweep");
  const ResultTable table = sweep_luminance(field, run_of(options, bar));
  const std::string name = fs::path(item_path(field.name)).filename().string();
  for (const auto& [truth, to] :
       {std::pair{LuminanceTruth::kBruteForce, "brute-force"}, std::pair{LuminanceTruth::kScene, "scene"}}) {
    const Plot plot = plot_luminance_sweep(table, truth);
    if (!plot.series.empty()) write_plot(plot, folder / fmt::format("sweep-{}-to-{}", name, to));
  }
  return table;
}

bool is_walk(const SweepOptions& options) {
  return options.method == "lut" && options.source == kWalk;
}

std::optional<float> exposure_for_tables(const SweepOptions& options) {
  if (options.method != "lut" || is_walk(options) || is_display_file(options.source)) return std::nullopt;
  return exposure_from(*image_of(options).view.colour);
}

ResultTable run_lut_sweep(const SweepOptions& options, const fs::path& folder) {
  const std::string name = fs::path(item_path(options.source)).stem().string();
  const DisplayImage picture = picture_of(options);
  ProgressBar bar("sweep");
  ResultTable table = sweep_lut(name, picture, run_of(options, bar));
  const Plot plot = plot_lut_sweep(table);
  if (plot.series.empty())
    tell(options.common, "no plot: tables of every size grade this picture without error");
  else
    write_plot(plot, folder / fmt::format("sweep-{}", name));
  if (!is_walk(options)) return table;
  ProgressBar counting_bar("counting");
  const ResultTable counting = sweep_pixel_counting(run_of(options, counting_bar));
  write_sweep_plot(counting, pixel_counting_sweep_plot(), "pixel-counting", folder);
  table.append(counting);
  return table;
}

}  // namespace plenolab
