#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

#include "experiments/cli/output.h"
#include "stimuli/render.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

void add_preset_rows(ResultTable& table, const Scene& scene, const char* preset_name,
                     const GridPreset& preset) {
  const auto add = [&](const char* quantity, double value, const char* unit) {
    table.add({quantity, value, unit, {{"scene", scene.id}, {"preset", std::string(preset_name)}}});
  };
  add("columns", preset.columns, "views");
  add("rows", preset.rows, "views");
  add("width", preset.width, "px");
  add("height", preset.height, "px");
  add("spacing_x", preset.spacing_x_m, "m");
  add("spacing_y", preset.spacing_y_m, "m");
  add("paths_per_pixel", preset.paths_per_pixel, "paths");
}

std::string preset_line(const GridPreset& preset) {
  return fmt::format("{}×{} views of {}×{}, {:g} m apart, {} paths a pixel", preset.columns, preset.rows,
                     preset.width, preset.height, preset.spacing_x_m, preset.paths_per_pixel);
}

void run_scenes(const Invocation& invocation, const CommonOptions& options) {
  Provenance provenance = begin_run(invocation, options);
  ResultTable table;
  std::string text;
  std::vector<SceneEntry> all(scenes().begin(), scenes().end());
  all.insert(all.end(), near_eye_scenes().begin(), near_eye_scenes().end());
  for (const SceneEntry& entry : all) {
    const Scene scene = entry.build();
    add_preset_rows(table, scene, "quick", scene.quick);
    add_preset_rows(table, scene, "paper", scene.paper);
    text += fmt::format("{:<15} {}\n{:<15} {}\n{:<15} quick: {}\n{:<15} paper: {}\n\n", scene.id, scene.title,
                        "", scene.description, "", preset_line(scene.quick), "", preset_line(scene.paper));
  }
  for (const LitSceneEntry& entry : display_scenes()) {
    const Scene scene = entry.build().scene;
    table.add({"for_displays", 1, "1", {{"scene", scene.id}}});
    text += fmt::format("{:<15} {}\n{:<15} {}\n{:<15} for 'plenolab luminance'\n\n", scene.id, scene.title,
                        "", scene.description, "");
  }
  if (!output_is_for_programs(options)) fmt::print("{}", text);
  write_results(table, provenance, options);
}

}  // namespace

void add_scenes_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<CommonOptions>();
  add_common_options(app, *options);
  app.footer("Example: plenolab scenes");
  app.callback([options, &invocation] { run_scenes(invocation, *options); });
}

}  // namespace plenolab
