#include "experiments/sweep_optimise.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "experiments/optimise/tone_optimiser.h"

namespace plenolab {

namespace {

ToneOptimisation optimise_with(const OptimiseSetting& setting, const std::string& quantity,
                               const SceneImage& image, const ComparisonConditions& conditions) {
  ToneOptimisationOptions options;
  options.quantity = quantity;
  options.shrink = setting.shrink;
  options.evolution.children = setting.children;
  options.evolution.most_iterations = setting.iterations;
  return optimise_tones(image, conditions, options);
}

}  // namespace

std::vector<OptimiseSetting> all_optimise_settings() {
  std::vector<OptimiseSetting> settings;
  for (const int shrink : {1, 2, 4}) {
    settings.push_back({shrink, 4, 5});
    for (const int children : {4, 10, 20}) settings.push_back({shrink, children, 20});
  }
  return settings;
}

ResultTable sweep_optimise(const SweepImage& image, double cd_m2_per_unit, const std::string& quantity,
                           const std::vector<OptimiseSetting>& settings, const SweepRun& run) {
  ComparisonConditions conditions;
  conditions.cd_m2_per_unit = cd_m2_per_unit;
  conditions.threads = run.threads;
  const SceneImage& scene = *image.view.colour;
  const Objective objective = describe_objective(quantity);
  std::vector<SweepOutcome> outcomes;
  double best = std::numeric_limits<double>::infinity();
  for (const OptimiseSetting& setting : settings) {
    SweepOutcome& outcome = outcomes.emplace_back();
    outcome.setting = {{"shrink", static_cast<long long>(setting.shrink)},
                       {"children", static_cast<long long>(setting.children)},
                       {"iterations", static_cast<long long>(setting.iterations)},
                       {"search", fmt::format("{} × {}", setting.children, setting.iterations)}};
    const ToneOptimisation found = optimise_with(setting, quantity, scene, conditions);
    outcome.error = objective.cost(found.best_value);
    best = std::min(best, outcome.error);
    outcome.values = {
        {"objective", found.best_value, objective.unit},
        {"evaluations", static_cast<double>(found.evolution.trace.back().evaluations), "images"}};
    time_setting(
        outcome, [&] { optimise_with(setting, quantity, scene, conditions); }, run.runs);
    if (run.progress)
      run.progress(static_cast<double>(outcomes.size()) / static_cast<double>(settings.size()));
  }
  for (SweepOutcome& outcome : outcomes) {
    outcome.error -= best;
    outcome.values.push_back({"objective_excess", outcome.error, objective.unit});
  }
  ResultTable table;
  add_outcome_rows(table, {{"image", image.name}}, outcomes);
  return table;
}

SweepPlotDesign optimise_sweep_plot() {
  return {"objective", "Objective at full size", "1", {"shrink"}, "search"};
}

}  // namespace plenolab
