#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/display_options.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/operator_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/scenes.h"
#include "experiments/cli/viewing_options.h"
#include "experiments/cli/wide_table.h"
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

struct SweepOptions {
  CommonOptions common;
  std::string method, source;
  std::string out, cache;
  OperatorOptions chosen;
  double cd_m2_per_unit = 0;
  int runs = 3;
  bool force = false;
};

SceneStimulusOptions stimulus_options(const SweepOptions& options) {
  return {.cache = render_cache_folder(options.cache),
          .seed = options.common.seed,
          .threads = options.common.threads};
}

/// Whether the source is a file or folder; throws UsageError if it is a path where nothing is.
bool source_exists(const SweepOptions& options) {
  if (fs::exists(options.source)) return true;
  if (fs::path(options.source).has_parent_path())
    throw InputError(fmt::format("{} does not exist", options.source));
  return false;
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

/// What a method came to, with its plots below `folder`.
using RunMethod = ResultTable (*)(const SweepOptions& options, const fs::path& folder);

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

void write_sweep_plot(const ResultTable& table, const SweepPlotDesign& design, const std::string& name,
                      const fs::path& folder) {
  const Plot plot = plot_sweep(table, design);
  if (!plot.series.empty())
    write_plot(plot, folder / fmt::format("sweep-{}", fs::path(name).stem().string()));
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

/// Scenes are in cd/m²; of a file the scale must be known.
double scale_of(const SweepOptions& options) {
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
  const double cd_m2_per_unit = scale_of(options);
  ProgressBar bar("sweep");
  const ResultTable table =
      sweep_drim(image, cd_m2_per_unit, choice, all_drim_settings(), run_of(options, bar));
  write_sweep_plot(table, drim_sweep_plot(), image.name, folder);
  return table;
}

constexpr const char* kObjective = "feature_content_adaptive";

ResultTable run_optimise_sweep(const SweepOptions& options, const fs::path& folder) {
  const SweepImage image = image_of(options);
  const double cd_m2_per_unit = scale_of(options);
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

constexpr const char* kWalk = "walk";

bool is_walk(const SweepOptions& options) {
  return options.method == "lut" && options.source == kWalk;
}

/// Tables grade pictures: radiance is shown by a plain exposure with this factor, nothing for the walk and
/// for files that hold pictures.
std::optional<float> exposure_for_tables(const SweepOptions& options) {
  if (options.method != "lut" || is_walk(options) || is_display_file(options.source)) return std::nullopt;
  return exposure_from(*image_of(options).view.colour);
}

DisplayImage picture_of(const SweepOptions& options) {
  if (is_walk(options)) {
    const std::vector<WalkPose> path = walk_path();
    return WalkStage().frame(path[path.size() / 2], 960, 540, options.common.threads).picture;
  }
  if (is_display_file(options.source)) return read_display_image(options.source);
  const OperatorView view = image_of(options).view;
  return expose(*view.colour, exposure_from(*view.colour));
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

/// A method with the table in which people see its rows.
struct SweepMethod {
  const char* name;
  RunMethod run;
  std::vector<std::string> keys;
  std::vector<WideColumn> columns;
};

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

const std::vector<SweepMethod>& methods() {
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

const SweepMethod& method_of(const SweepOptions& options) {
  return *std::find_if(methods().begin(), methods().end(),
                       [&](const SweepMethod& method) { return method.name == options.method; });
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const SweepMethod& method : methods()) names.push_back(method.name);
  return names;
}

std::string item_of(const SweepOptions& options) {
  const bool file = fs::exists(options.source);
  return fmt::format("{} {}", options.method, file ? item_path(options.source) : options.source);
}

/// --out, or a folder below results/ that tells sweeps apart.
std::string output_folder(const SweepOptions& options) {
  if (!options.out.empty()) return options.out;
  return fmt::format("results/sweep-{}-{}", options.method,
                     fs::path(item_path(options.source)).filename().string());
}

void run_sweep(const Invocation& invocation, const SweepOptions& options) {
  if (options.method != "adjustment" && options.method != "drim" &&
      !(options.chosen.name.empty() && options.chosen.variant.empty() && options.chosen.settings.empty()))
    throw UsageError("--operator, --variant and --set are for the sweeps of adjustment and drim");
  const bool absolute = options.method == "drim" || options.method == "optimise";
  if (options.cd_m2_per_unit > 0 && !absolute)
    throw UsageError("--cd-m2-per-unit is for the sweeps of drim and optimise");
  // Wrong use is told before anything is run.
  if (options.method == "adjustment") adjusted_operator(options);
  if (options.method == "drim") mapping_operator(options);
  Provenance provenance = begin_run(invocation, options.common);
  provenance.parameters["method"] = options.method;
  provenance.parameters["source"] = options.source;
  provenance.parameters["runs"] = options.runs;
  if (absolute) provenance.parameters["cd_m2_per_unit"] = scale_of(options);
  if (!is_walk(options) && source_exists(options)) add_input(provenance, options.source);
  const std::optional<float> exposure = exposure_for_tables(options);
  if (exposure) provenance.parameters["exposure"] = static_cast<double>(*exposure);
  const SweepMethod& method = method_of(options);
  ResultTable table;
  const std::string out = output_folder(options), item = item_of(options);
  write_result_folder({out, "sweep", item, options.force}, provenance, [&](const fs::path& folder) {
    table = method.run(options, folder);
    write_text_file(folder / "rows.csv", to_csv(table));
  });
  if (!output_is_for_programs(options.common))
    fmt::print("{}", to_wide_text(table, method.keys, method.columns));
  write_results(table, provenance, options.common);
  if (exposure)
    tell(options.common,
         fmt::format("graded as pictures: radiance times {:.4g}, cut to 1, gamma 2.2 (no tone mapping)",
                     *exposure));
  tell(options.common, fmt::format("wrote plots and rows.csv to {}", out));
}

}  // namespace

void add_sweep_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<SweepOptions>();
  app.add_option("method", options->method, "Method to sweep")->required()->check(one_of(method_names()));
  app.add_option(
         "source", options->source,
         "Scene id, or: synthesis: folder of a light field, every other view of which is held out as "
         "truth; bilateral, histogram, drim, optimise: image with radiance; adjustment: folder of a light "
         "field; "
         "reprojection: "
         "scenes only; luminance: pillars, sphere, or folder with display.json; lut: walk, or an image")
      ->required();
  app.add_option("-o,--out", options->out,
                 "Folder for plots (.svg .pdf .gp .csv) and rows.csv (default: results/sweep-METHOD-SOURCE)")
      ->check(not_empty());
  app.add_option("--runs", options->runs,
                 "Timed runs of every setting and position; of optimise also searches with different seeds")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  app.add_option("--cache", options->cache, "Folder of rendered views (default ~/.cache/plenolab)");
  add_operator_options(app, options->chosen);
  add_luminance_scale_option(app, options->cd_m2_per_unit);
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "synthesis: search, step, key views against rendered or captured truth. bilateral: sampling of the "
      "grid "
      "against the exact filter. histogram: bins. adjustment: support and width of key-view adjustment. "
      "drim: "
      "scale of the images and orientations. optimise: scale of the image, children and iterations of the "
      "search. drim and optimise need to know what a pixel value of 1 is. reprojection: steps, cameras and "
      "supersampling for the near-eye display. luminance: samples, pinhole images, smoothing and spread on a "
      "projector display. lut: size and interpolation of look-up tables, for walk also down-scaling of pixel "
      "counting.\n"
      "Examples: plenolab sweep synthesis cellar -o results/sweep\n"
      "          plenolab sweep bilateral view.exr\n"
      "          plenolab sweep optimise photo.exr --cd-m2-per-unit 100");
  app.callback([options, &invocation] { run_sweep(invocation, *options); });
}

}  // namespace plenolab
