#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "core/io/exr.h"
#include "core/lightfield/light_field_folder.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/scenes.h"
#include "stimuli/render_cache.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

struct RenderOptions {
  CommonOptions common;
  std::string scene, out, at, cache;
  std::string preset = "quick";
  int columns = 0, rows = 0, width = 0, height = 0, paths = 0;
  bool keep_everything = false, force = false;
};

/// The preset's grid with the sizes overridden on the command line; the aspect ratio follows a given width.
ViewGrid requested_grid(const Scene& scene, Preset preset, const RenderOptions& options) {
  ViewGrid grid = grid_of(scene, preset);
  if (options.columns > 0) grid.columns = options.columns;
  if (options.rows > 0) grid.rows = options.rows;
  if (options.width > 0) {
    grid.height = std::max(1, grid.height * options.width / grid.width);
    grid.width = options.width;
  }
  if (options.height > 0) grid.height = options.height;
  return grid;
}

void add_pruned_rows(ResultTable& table, const std::string& scene, const std::vector<PrunedStage>& pruned) {
  for (const PrunedStage& stage : pruned)
    table.add(
        {"stage_left_out", 1, "1", {{"scene", scene}, {"stage", stage.stage}, {"reason", stage.reason}}});
}

void render_one_view(const Scene& scene, const ViewGrid& grid, const RenderSettings& settings,
                     const RenderOptions& options, Provenance& provenance) {
  const CameraPosition position = parse_position(options.at, "--at");
  require_extension(options.out, ".exr");
  ProgressBar bar("rendering " + scene.id);
  const CachedView view = render_view_cached(PreparedScene(scene), grid, position, settings,
                                             render_cache_folder(options.cache), bar.callback());
  write_exr(options.out, view.rendered.view.colour, {{"disparity", &view.rendered.view.disparity}},
            {.colour_type = ExrPixelType::kFloat, .float_attributes = {{kWhiteLuminance, 1.0f}}});
  write_run_json_beside(options.out, provenance);
  ResultTable table;
  const RenderStats& stats = view.rendered.stats;
  const std::vector<std::pair<std::string, Cell>> columns{
      {"scene", scene.id}, {"s", position.s}, {"t", position.t}};
  table.add({"from_cache", view.from_cache ? 1.0 : 0.0, "1", columns});
  if (!view.from_cache) {
    table.add({"seconds", stats.seconds, "s", columns});
    table.add({"rays", static_cast<double>(stats.rays()), "rays", columns});
    table.add({"rays_per_second", stats.mrays_per_second(), "Mrays/s", columns});
    add_pruned_rows(table, scene.id, stats.pruned);
  }
  emit_results(table, provenance, options.common);
}

void render_grid(const Scene& scene, const ViewGrid& grid, const RenderSettings& settings,
                 const RenderOptions& options, Provenance& provenance) {
  const LightField field = render_light_field(scene, grid, settings, render_cache_folder(options.cache));
  const std::string item = fmt::format("{} --preset {}", scene.id, options.preset);
  write_result_folder({options.out, "render", item, options.force}, provenance, [&](const auto& folder) {
    ProgressBar bar("rendering " + scene.id);
    write_light_field(folder, field, {.colour_type = ExrPixelType::kFloat}, bar.callback());
  });
  ResultTable table;
  const std::vector<std::pair<std::string, Cell>> columns{{"scene", scene.id}};
  table.add({"views", static_cast<double>(grid.columns) * grid.rows, "views", columns});
  table.add({"max_disparity", field.max_disparity_px(), "px", columns});
  table.add({"seconds", provenance.duration_s, "s", columns});
  emit_results(table, provenance, options.common);
  tell(options.common, fmt::format("wrote the light field {}", options.out));
}

void run_render(const Invocation& invocation, const RenderOptions& options) {
  const Scene scene = scene_named(options.scene);
  const Preset preset = options.preset == "paper" ? Preset::kPaper : Preset::kQuick;
  const ViewGrid grid = requested_grid(scene, preset, options);
  RenderSettings settings;
  settings.paths_per_pixel = options.paths > 0 ? options.paths : preset_of(scene, preset).paths_per_pixel;
  settings.seed = options.common.seed;
  settings.threads = options.common.threads;
  settings.prune = !options.keep_everything;
  Provenance provenance = begin_run(invocation, options.common);
  provenance.parameters["scene"] = scene.id;
  provenance.parameters["preset"] = options.preset;
  provenance.parameters["paths_per_pixel"] = settings.paths_per_pixel;
  if (options.at.empty())
    render_grid(scene, grid, settings, options, provenance);
  else
    render_one_view(scene, grid, settings, options, provenance);
}

}  // namespace

void add_render_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<RenderOptions>();
  app.add_option("scene", options->scene, "Scene id, see 'plenolab scenes'")->required();
  app.add_option("-o,--out", options->out, "Folder of the light field; with --at the .exr file")
      ->required()
      ->check(not_empty());
  app.add_option("--preset", options->preset, "Grid, image size and number of paths")
      ->check(one_of({"quick", "paper"}))
      ->capture_default_str();
  app.add_option("--at", options->at, "Render only the view at S,T (any position, in view spacings)");
  app.add_option("--columns", options->columns, "Override the number of columns")
      ->check(whole_number(1, 1000));
  app.add_option("--rows", options->rows, "Override the number of rows")->check(whole_number(1, 1000));
  app.add_option("--width", options->width, "Override the image width (the height follows)")
      ->check(whole_number(1, 16384));
  app.add_option("--height", options->height, "Override the image height")->check(whole_number(1, 16384));
  app.add_option("--paths", options->paths, "Override the paths per pixel, a multiple of 16")
      ->check(multiple_of(kBlockSamples, 1 << 20));
  app.add_option("--cache", options->cache, "Folder of rendered views (default ~/.cache/plenolab)");
  app.add_flag("--no-prune", options->keep_everything, "Run also the stages the scene does not need");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab render cellar -o results/cellar\n"
      "          plenolab render cellar --at 1.5,0.5 -o truth.exr");
  app.callback([options, &invocation] { run_render(invocation, *options); });
}

}  // namespace plenolab
