#include "experiments/reproduce/laboratory.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "analysis/timing.h"
#include "core/base/parallel.h"
#include "experiments/reproduce/display/near_eye_bench.h"
#include "experiments/reproduce/luminance/luminance_bench.h"
#include "experiments/reproduce/lut/walk_bench.h"
#include "experiments/reproduce/optimisation/optimisation_bench.h"
#include "experiments/reproduce/tonemap/mapping_bench.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

struct Laboratory::SceneState {
  PreparedScene scene;
  std::optional<LightField> light_field;
  std::optional<Synthesizer> synthesizer;
};

const char* name_of(Effort effort) {
  switch (effort) {
    case Effort::kTiny:
      return "tiny";
    case Effort::kQuick:
      return "quick";
    case Effort::kPaper:
      return "paper";
  }
  return "";
}

std::vector<CameraPosition> scored_positions(const ViewGrid& grid) {
  const double s = std::max(0, (grid.columns - 2) / 2), t = std::max(0, (grid.rows - 2) / 2);
  std::vector<CameraPosition> positions;
  for (const CameraPosition offset : {CameraPosition{0.5, 0.5}, {0.5, 0.0}, {0.25, 0.6}}) {
    const CameraPosition position{s + offset.s, t + offset.t};
    if (grid.contains(position)) positions.push_back(position);
  }
  return positions;
}

Laboratory::Laboratory(LaboratoryOptions options) : options_(std::move(options)) {}
Laboratory::~Laboratory() = default;

MappingBench& Laboratory::mapping_bench() {
  if (!mapping_bench_) mapping_bench_ = std::make_unique<MappingBench>(*this);
  return *mapping_bench_;
}

NearEyeBench& Laboratory::near_eye_bench() {
  if (!near_eye_bench_) near_eye_bench_ = std::make_unique<NearEyeBench>(*this);
  return *near_eye_bench_;
}

LuminanceBench& Laboratory::luminance_bench() {
  if (!luminance_bench_) luminance_bench_ = std::make_unique<LuminanceBench>(options_);
  return *luminance_bench_;
}

WalkBench& Laboratory::walk_bench() {
  if (!walk_bench_) walk_bench_ = std::make_unique<WalkBench>(options_);
  return *walk_bench_;
}

OptimisationBench& Laboratory::optimisation_bench() {
  if (!optimisation_bench_) optimisation_bench_ = std::make_unique<OptimisationBench>(options_);
  return *optimisation_bench_;
}

std::vector<std::string> Laboratory::scene_ids() const {
  return {"cellar", "cellar-shafts", "tunnel", "tree", "boats"};
}

Laboratory::SceneState& Laboratory::state(const std::string& id) {
  std::unique_ptr<SceneState>& state = scenes_[id];
  if (!state) state = std::make_unique<SceneState>(SceneState{PreparedScene(build_scene(id)), {}, {}});
  return *state;
}

const Scene& Laboratory::scene(const std::string& id) {
  return state(id).scene.scene();
}

ViewGrid Laboratory::grid(const std::string& id) {
  const Scene& s = scene(id);
  if (options_.effort == Effort::kPaper) return grid_of(s, Preset::kPaper);
  ViewGrid grid = grid_of(s, Preset::kQuick);
  if (options_.effort == Effort::kTiny) {
    grid.columns = std::min(grid.columns, 3);
    grid.rows = std::min(grid.rows, 3);
    grid.height = std::max(1, grid.height * 96 / grid.width);
    grid.width = 96;
  }
  return grid;
}

int Laboratory::paths_per_pixel(const std::string& id) {
  if (options_.effort == Effort::kTiny) return kBlockSamples;
  return preset_of(scene(id), options_.effort == Effort::kPaper ? Preset::kPaper : Preset::kQuick)
      .paths_per_pixel;
}

RenderSettings Laboratory::settings(int paths_per_pixel, std::uint64_t seed_offset) const {
  RenderSettings settings;
  settings.paths_per_pixel = options_.effort == Effort::kTiny ? kBlockSamples : paths_per_pixel;
  settings.seed = options_.seed + seed_offset;
  settings.threads = options_.threads;
  return settings;
}

KeyView<SceneReferred> Laboratory::render_prepared(const PreparedScene& scene, const ViewGrid& grid,
                                                   CameraPosition position, int paths_per_pixel,
                                                   std::uint64_t seed_offset) {
  CachedView view =
      render_view_cached(scene, grid, position, settings(paths_per_pixel, seed_offset), options_.cache);
  const std::lock_guard lock(tally_mutex_);
  ++(view.from_cache ? tally_.from_cache : tally_.rendered);
  tally_.seconds += view.rendered.stats.seconds;
  tally_.rays += view.rendered.stats.rays();
  if (options_.on_view) options_.on_view(tally_);
  return std::move(view.rendered.view);
}

LightField Laboratory::light_field(const std::string& id) {
  SceneState& s = state(id);
  if (!s.light_field) {
    const ViewGrid views = grid(id);
    const int paths = paths_per_pixel(id);
    s.light_field.emplace(views, RadianceUnit::kCdM2, id, [this, &s, views, paths](int column, int row) {
      return render_prepared(s.scene, views, {static_cast<double>(column), static_cast<double>(row)}, paths);
    });
  }
  return *s.light_field;
}

const Synthesizer& Laboratory::synthesizer(const std::string& id) {
  SceneState& s = state(id);
  if (!s.synthesizer) s.synthesizer.emplace(light_field(id));
  return *s.synthesizer;
}

KeyView<SceneReferred> Laboratory::truth(const std::string& id, CameraPosition position, int path_factor) {
  SceneState& s = state(id);
  return render_prepared(s.scene, grid(id), position, path_factor * paths_per_pixel(id));
}

std::vector<SceneImage> Laboratory::truth_rows(const std::string& id,
                                               const std::vector<CameraPosition>& positions, int row,
                                               int path_factor) {
  SceneState& s = state(id);
  const ViewGrid views = grid(id);
  RenderSettings one_row = settings(path_factor * paths_per_pixel(id));
  one_row.row_begin = row;
  one_row.row_end = row + 1;
  one_row.threads = 1;  // a row is one piece of work: the rows are shared out instead
  std::vector<SceneImage> rows(positions.size());
  std::vector<std::uint64_t> rays(positions.size());
  const Stopwatch watch;
  parallel_for(static_cast<int>(positions.size()), 1, options_.threads, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const CachedView view = render_view_cached(s.scene, views, positions[i], one_row, options_.cache);
      rows[i] = SceneImage(views.width, 1);
      std::copy_n(view.rendered.view.colour.row(row), views.width, rows[i].row(0));
      rays[i] = view.rendered.stats.rays();
    }
  });
  const std::uint64_t all_rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  const std::lock_guard lock(tally_mutex_);
  tally_.rays += all_rays;
  if (all_rays > 0) tally_.seconds += watch.seconds();
  return rows;
}

const PreparedScene& Laboratory::prepared(const Scene& scene) {
  const std::string key = scene.id + '\n' + scene.variant;
  const auto found = prepared_variants_.find(key);
  return found != prepared_variants_.end() ? found->second
                                           : prepared_variants_.emplace(key, scene).first->second;
}

KeyView<SceneReferred> Laboratory::render(const Scene& scene, const ViewGrid& grid, CameraPosition position,
                                          int paths_per_pixel, std::uint64_t seed_offset) {
  return render_prepared(prepared(scene), grid, position, paths_per_pixel, seed_offset);
}

LightField Laboratory::render_field(const Scene& scene, const ViewGrid& grid, int paths_per_pixel,
                                    std::uint64_t seed_offset) {
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      views.push_back(render(scene, grid, {static_cast<double>(column), static_cast<double>(row)},
                             paths_per_pixel, seed_offset));
  const std::string name = scene.variant.empty() ? scene.id : scene.id + " (" + scene.variant + ")";
  return LightField::from_views(grid, RadianceUnit::kCdM2, name, std::move(views));
}

ViewGrid Laboratory::scaled(ViewGrid grid) const {
  if (options_.effort == Effort::kTiny) {
    grid.width = std::max(1, grid.width / 3);
    grid.height = std::max(1, grid.height / 3);
  }
  return grid;
}

}  // namespace plenolab
