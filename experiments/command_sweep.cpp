#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lightfield/subsample.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/scenes.h"
#include "experiments/cli/wide_table.h"
#include "experiments/sweep_stimuli.h"
#include "experiments/sweep_synthesis.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct SweepOptions {
  CommonOptions common;
  std::string method, source;
  std::string out, cache;
  int runs = 3;
  bool force = false;
};

std::vector<SweepStimulus> stimuli_of(const SweepOptions& options) {
  if (fs::is_directory(options.source)) {
    const AnyLightField any = open_any_light_field(options.source);
    const auto* field = std::get_if<LightField>(&any);
    if (!field)
      throw InputError(
          fmt::format("{} is display-referred: a sweep needs radiance (convert HCI folders with --linear)",
                      options.source));
    return {stimulus_from_captured(*field)};
  }
  if (fs::path(options.source).has_parent_path())
    throw InputError(fmt::format("{} is not a folder", options.source));
  return stimuli_from_scene(scene_named(options.source).id, {.cache = render_cache_folder(options.cache),
                                                             .seed = options.common.seed,
                                                             .threads = options.common.threads});
}

std::string item_of(const SweepOptions& options) {
  const bool folder = fs::is_directory(options.source);
  return fmt::format("{} {}", options.method, folder ? item_path(options.source) : options.source);
}

/// --out, or a folder below results/ that tells sweeps apart.
std::string output_folder(const SweepOptions& options) {
  if (!options.out.empty()) return options.out;
  return fmt::format("results/sweep-{}-{}", options.method,
                     fs::path(item_path(options.source)).filename().string());
}

void write_sweep(const ResultTable& table, const std::vector<SweepStimulus>& stimuli,
                 const fs::path& folder) {
  for (const SweepStimulus& s : stimuli) {
    const int width = s.key_views.grid().width;
    write_plot(plot_synthesis_sweep(table, s.name, width),
               folder / fmt::format("sweep-{}-{}px", s.name, width));
  }
  write_text_file(folder / "rows.csv", to_csv(table));
}

void run_sweep(const Invocation& invocation, const SweepOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  provenance.parameters["method"] = options.method;
  provenance.parameters["source"] = options.source;
  provenance.parameters["runs"] = options.runs;
  const std::vector<SweepStimulus> stimuli = stimuli_of(options);
  SynthesisSweepOptions sweep;
  sweep.runs = options.runs;
  sweep.threads = options.common.threads;
  ResultTable table;
  const std::string out = output_folder(options), item = item_of(options);
  write_result_folder({out, "sweep", item, options.force}, provenance, [&](const fs::path& folder) {
    ProgressBar bar("sweep");
    table = sweep_synthesis(stimuli, sweep, bar.callback());
    write_sweep(table, stimuli, folder);
  });
  if (!output_is_for_programs(options.common))
    fmt::print("{}",
               to_wide_text(table, {"scene", "width", "search", "key_views", "step_px"}, sweep_columns()));
  write_results(table, provenance, options.common);
  tell(options.common, fmt::format("wrote plots and rows.csv to {}", out));
}

}  // namespace

void add_sweep_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<SweepOptions>();
  app.add_option("method", options->method, "Method to sweep")->required()->check(one_of({"synthesis"}));
  app.add_option("source", options->source,
                 "Scene id (truth is rendered, at three image sizes), or folder of a light field (every "
                 "other view is held "
                 "out as truth)")
      ->required();
  app.add_option("-o,--out", options->out,
                 "Folder for plots (.svg .pdf .gp .csv) and rows.csv (default: results/sweep-METHOD-SOURCE)")
      ->check(not_empty());
  app.add_option("--runs", options->runs, "Timed runs of every setting and position")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  app.add_option("--cache", options->cache, "Folder of rendered views (default ~/.cache/plenolab)");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer("Example: plenolab sweep synthesis cellar -o results/sweep");
  app.callback([options, &invocation] { run_sweep(invocation, *options); });
}

}  // namespace plenolab
