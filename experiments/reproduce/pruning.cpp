#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/timing.h"
#include "core/image/colour.h"
#include "experiments/reproduce/reproduction.h"
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

/// What leaving out did to one result.
struct PruningOutcome {
  std::string part, stimulus;
  std::vector<PrunedStage> stages;
  bool equal = false;
  double seconds_pruned = 0, seconds_full = 0;
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

/// Runs `work(true)` and `work(false)`, with and without leaving out, by turns, so that a change of the
/// machine's speed meets both; fills in the median times and returns the last two results.
template <class Work>
auto time_by_turns(PruningOutcome& outcome, const Work& work) {
  constexpr int kRuns = 3;
  std::array<std::vector<double>, 2> seconds;
  std::array<decltype(work(true)), 2> results;
  for (int run = 0; run < kRuns; ++run)
    for (const std::size_t full : {0u, 1u}) {
      const Stopwatch watch;
      results[full] = work(full == 0);
      seconds[full].push_back(watch.seconds());
    }
  outcome.seconds_pruned = summarise_times(seconds[0]).median_s;
  outcome.seconds_full = summarise_times(seconds[1]).median_s;
  return results;
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

/// Each stage once, also where it was left out for several key views.
std::string stage_names(const PruningOutcome& outcome) {
  std::vector<std::string> names;
  for (const PrunedStage& stage : outcome.stages)
    if (std::find(names.begin(), names.end(), stage.stage) == names.end()) names.push_back(stage.stage);
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

void add_outcome_rows(ResultTable& rows, const PruningOutcome& o) {
  const Columns columns{{"part", o.part}, {"stimulus", o.stimulus}};
  rows.add({"equal_with_and_without", o.equal ? 1.0 : 0.0, "1", columns});
  rows.add({"seconds_pruned", o.seconds_pruned, "s", columns});
  rows.add({"seconds_full", o.seconds_full, "s", columns});
  for (const PrunedStage& stage : o.stages) {
    Columns with_stage = columns;
    with_stage.emplace_back("stage", stage.stage);
    with_stage.emplace_back("reason", stage.reason);
    rows.add({"stage_left_out", 1, "1", with_stage});
  }
}

ReportTable reasons_table(const std::vector<PruningOutcome>& outcomes) {
  ReportTable table{"What was left out and why", {"part", "stimulus", "stage", "reason"}, {}};
  for (const PruningOutcome& o : outcomes)
    for (const PrunedStage& stage : o.stages)
      table.rows.push_back({o.part, o.stimulus, stage.stage, stage.reason});
  return table;
}

ReportTable savings_table(const std::vector<PruningOutcome>& outcomes) {
  ReportTable table{"Time with and without leaving out; results compared bit by bit",
                    {"part", "stimulus", "left out", "with [ms]", "without [ms]", "saved [%]", "equal"},
                    {}};
  for (const PruningOutcome& o : outcomes)
    table.rows.push_back({o.part, o.stimulus, stage_names(o), o.seconds_pruned * 1000, o.seconds_full * 1000,
                          o.seconds_full > 0 ? 100 * (1 - o.seconds_pruned / o.seconds_full) : 0.0,
                          std::string(o.equal ? "yes" : "NO")});
  table.digits = 3;
  return table;
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
