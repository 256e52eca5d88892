#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "experiments/reproduce/pruning_outcome.h"
#include "experiments/score.h"

namespace plenolab {

ReproductionResult reproduce_pruning(Laboratory& laboratory);

namespace {

/// Width of the views rendered with and without leaving out: small, but with every kind of path in them.
constexpr int kRenderedWidth = 64;

/// A stimulus, and where in it a view is wanted.
struct SynthesisCase {
  std::string name;
  LightField field;
  CameraPosition position;
};

/// A textured plane parallel to the camera plane at `disparity_px`: no depth edges, one disparity.
LightField plane_field(ViewGrid grid, float disparity_px) {
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      KeyView<SceneReferred> view{SceneImage(grid.width, grid.height),
                                  DisparityMap(grid.width, grid.height, disparity_px)};
      for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
          const double u = x + column * static_cast<double>(disparity_px);
          const double v = y + row * static_cast<double>(disparity_px);
          const float value = static_cast<float>(1 + 0.5 * std::sin(0.21 * u) + 0.4 * std::cos(0.17 * v));
          view.colour.at(x, y) = {value, value * 0.8f, value * 0.6f};
        }
      views.push_back(std::move(view));
    }
  return LightField::from_views(grid, RadianceUnit::kRelative, "plane", std::move(views));
}

std::vector<SynthesisCase> synthesis_cases(Laboratory& laboratory) {
  std::vector<SynthesisCase> cases;
  const ViewGrid grid{2,
                      2,
                      0.1,
                      0.1,
                      laboratory.scaled({1, 1, 1, 1, 480, 270, 60}).width,
                      laboratory.scaled({1, 1, 1, 1, 480, 270, 60}).height,
                      60};
  cases.push_back({"plane without depth edges", plane_field(grid, 12), {0.4, 0.3}});
  cases.push_back({"plane at infinity (disparity 0)", plane_field(grid, 0), {0.4, 0.3}});
  cases.push_back({"plane nearer than one search step (0.5 px)", plane_field(grid, 0.5f), {0.4, 0.3}});
  for (const std::string& id : laboratory.scene_ids()) {
    cases.push_back({id + ", on a key view", laboratory.light_field(id), {1, 1}});
    cases.push_back({id + ", between key views", laboratory.light_field(id), {0.5, 0.5}});
  }
  return cases;
}

PruningOutcome prune_synthesis(const SynthesisCase& c, int threads) {
  const Synthesizer synthesizer(c.field);
  SynthesisOptions options;
  options.threads = threads;
  synthesizer.synthesize(c.position, options);  // prepares the key views
  PruningOutcome outcome{.part = "synthesis", .stimulus = c.name, .stages = {}};
  const auto [pruned, full] = time_by_turns(outcome, [&](bool prune) {
    options.prune = prune;
    return synthesizer.synthesize(c.position, options);
  });
  outcome.stages = pruned.pruned;
  outcome.equal = pruned.image == full.image && pruned.unseen == full.unseen &&
                  pruned.visible_views == full.visible_views && pruned.restored == full.restored;
  return outcome;
}

PruningOutcome prune_rendering(Laboratory& laboratory, const std::string& id) {
  ViewGrid grid = laboratory.grid(id);
  grid.height = std::max(1, grid.height * kRenderedWidth / grid.width);
  grid.width = kRenderedWidth;
  const PreparedScene scene(laboratory.scene(id));
  RenderSettings settings;
  settings.paths_per_pixel = kBlockSamples;
  settings.seed = laboratory.options().seed;
  settings.threads = laboratory.options().threads;
  scene.state();  // prepared now, so that no rendering is charged for it
  PruningOutcome outcome{.part = "rendering", .stimulus = id, .stages = {}};
  const auto [pruned, full] = time_by_turns(outcome, [&](bool prune) {
    settings.prune = prune;
    return render_view(scene, grid, {0, 0}, settings);
  });
  outcome.stages = pruned.stats.pruned;
  outcome.equal = pruned.view.colour == full.view.colour && pruned.view.disparity == full.view.disparity;
  return outcome;
}

}  // namespace

ReproductionResult reproduce_pruning(Laboratory& laboratory) {
  std::vector<PruningOutcome> outcomes;
  for (const SynthesisCase& c : synthesis_cases(laboratory))
    outcomes.push_back(prune_synthesis(c, laboratory.options().threads));
  for (const std::string& id : laboratory.scene_ids()) outcomes.push_back(prune_rendering(laboratory, id));
  ReproductionResult result;
  for (const PruningOutcome& o : outcomes) add_outcome_rows(result.rows, o);
  const auto equal =
      std::count_if(outcomes.begin(), outcomes.end(), [](const PruningOutcome& o) { return o.equal; });
  result.ours_shows = fmt::format(
      "Before work begins the stimulus is profiled, and a stage that cannot change the result is left out. "
      "{} of {} results "
      "are equal bit by bit with and without leaving out.",
      equal, outcomes.size());
  result.add_table(savings_table(outcomes));
  result.add_table(reasons_table(outcomes));
  return result;
}

}  // namespace plenolab
