#include "experiments/sweep_stimuli.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/image/repair.h"
#include "core/lightfield/subsample.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/tonemap_fit.h"
#include "stimuli/render_cache.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

/// Inside the cell, off its symmetry lines, so that the four weights and search lengths differ.
constexpr CameraPosition kPositions[] = {{0.5, 0.5}, {0.25, 0.6}, {0.7, 0.15}};

SweepStimulus stimulus_at_width(const PreparedScene& scene, ViewGrid grid, int width,
                                const RenderSettings& settings, const std::filesystem::path& cache) {
  grid.height = std::max(1, grid.height * width / grid.width);
  grid.width = width;
  const auto view_at = [=](CameraPosition position) {
    return render_view_cached(scene, grid, position, settings, cache).rendered.view;
  };
  SweepStimulus stimulus{scene.scene().id,
                         LightField(grid, RadianceUnit::kCdM2, scene.scene().id,
                                    [view_at](int column, int row) {
                                      return view_at({static_cast<double>(column), static_cast<double>(row)});
                                    }),
                         {std::begin(kPositions), std::end(kPositions)},
                         [view_at](CameraPosition position) { return view_at(position).colour; }};
  return stimulus;
}

RenderSettings settings_of(const Scene& scene, const SceneStimulusOptions& options) {
  RenderSettings settings;
  settings.paths_per_pixel =
      options.paths_per_pixel > 0 ? options.paths_per_pixel : scene.quick.paths_per_pixel;
  settings.seed = options.seed;
  settings.threads = options.threads;
  return settings;
}

}  // namespace

std::vector<SweepStimulus> stimuli_from_scene(const std::string& scene_id,
                                              const SceneStimulusOptions& options) {
  const PreparedScene scene(build_scene(scene_id));
  ViewGrid grid = grid_of(scene.scene(), Preset::kQuick);
  grid.columns = 2;
  grid.rows = 2;
  const int full_width = options.width > 0 ? options.width : grid.width;
  const RenderSettings settings = settings_of(scene.scene(), options);
  std::vector<SweepStimulus> stimuli;
  for (const int divisor : options.divisors)
    stimuli.push_back(
        stimulus_at_width(scene, grid, std::max(8, full_width / divisor), settings, options.cache));
  return stimuli;
}

SweepStimulus stimulus_from_captured(const LightField& captured) {
  const ViewGrid grid = captured.grid();
  const LightField key_views = subsample(captured, 2);
  const ViewGrid sparse = key_views.grid();
  const int step_x = grid.columns > 1 ? 2 : 1, step_y = grid.rows > 1 ? 2 : 1;
  std::vector<CameraPosition> held_out;
  for (int row = 0; row <= (sparse.rows - 1) * step_y; ++row)
    for (int column = 0; column <= (sparse.columns - 1) * step_x; ++column)
      if (column % step_x != 0 || row % step_y != 0)
        held_out.push_back({static_cast<double>(column) / step_x, static_cast<double>(row) / step_y});
  if (held_out.empty())
    throw InputError(fmt::format("{}: no view of the {}×{} grid lies between every other one",
                                 captured.name(), grid.columns, grid.rows));
  std::vector<CameraPosition> chosen;
  const std::size_t count = std::min<std::size_t>(3, held_out.size());
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(held_out[(2 * i + 1) * held_out.size() / (2 * count)]);
  const std::string name = std::filesystem::weakly_canonical(captured.name()).filename().string();
  return {name, key_views, chosen, [captured, step_x, step_y](CameraPosition position) {
            SceneImage truth = captured
                                   .view(static_cast<int>(position.s * step_x + 0.5),
                                         static_cast<int>(position.t * step_y + 0.5))
                                   ->colour;
            repair(truth);
            return truth;
          }};
}

SweepImage image_from_file(const std::filesystem::path& path) {
  return {path.filename().string(), read_operator_view(path)};
}

SweepImage image_from_scene(const std::string& scene_id, const SceneStimulusOptions& options) {
  const ViewGrid grid = grid_of(build_scene(scene_id), Preset::kQuick);
  const LightField field = field_from_scene(scene_id, options);
  return {scene_id, operator_view(field, grid.columns / 2, grid.rows / 2)};
}

LightField field_from_scene(const std::string& scene_id, const SceneStimulusOptions& options) {
  const Scene scene = build_scene(scene_id);
  ViewGrid grid = grid_of(scene, Preset::kQuick);
  if (options.width > 0) {
    grid.height = std::max(1, grid.height * options.width / grid.width);
    grid.width = options.width;
  }
  return render_light_field(scene, grid, settings_of(scene, options), options.cache);
}

std::vector<WideColumn> sweep_columns() {
  return {{"psnr_gamma_db", "PSNR gamma [dB]"},     {"seconds_median", "seconds"},
          {"memory_held_mib", "memory held [MiB]"}, {"memory_peak_mib", "peak [MiB]"},
          {"samples_per_search", "samples"},        {"on_pareto_front", "Pareto front"}};
}

}  // namespace plenolab
