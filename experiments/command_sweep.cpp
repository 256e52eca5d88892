#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/viewing_options.h"
#include "experiments/sweep_methods.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

const SweepMethod& method_of(const SweepOptions& options) {
  return *std::find_if(sweep_methods().begin(), sweep_methods().end(),
                       [&](const SweepMethod& method) { return method.name == options.method; });
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const SweepMethod& method : sweep_methods()) names.push_back(method.name);
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
  if (absolute) provenance.parameters["cd_m2_per_unit"] = luminance_scale_of(options);
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
         "field; reprojection: scenes only; luminance: pillars, sphere, or folder with display.json; lut: "
         "walk, or an image")
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
      "grid against the exact filter. histogram: bins. adjustment: support and width of key-view adjustment. "
      "drim: scale of the images and orientations. optimise: scale of the image, children and iterations of "
      "the "
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
