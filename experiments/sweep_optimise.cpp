#include "experiments/sweep_optimise.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/quantile.h"
#include "experiments/optimise/tone_optimiser.h"

namespace plenolab {

namespace {

ToneOptimisation optimise_with(const OptimiseSetting& setting, const std::string& quantity,
                               const SceneImage& image, const ComparisonConditions& conditions,
                               std::uint64_t seed) {
  ToneOptimisationOptions options;
  options.quantity = quantity;
  options.shrink = setting.shrink;
  options.evolution.children = setting.children;
  options.evolution.most_iterations = setting.iterations;
  options.evolution.seed = seed;
  return optimise_tones(image, conditions, options);
}

/// The median of searches with several seeds, and how far these lie apart.
void search_with_seeds(SweepOutcome& outcome, const OptimiseSetting& setting, const Objective& objective,
                       const SceneImage& image, const ComparisonConditions& conditions, const SweepRun& run) {
  std::vector<double> costs, evaluations;
  for (int k = 0; k < run.runs; ++k) {
    const ToneOptimisation found = optimise_with(setting, objective.quantity, image, conditions,
                                                 run.seed + static_cast<std::uint64_t>(k));
    costs.push_back(objective.cost(found.best_value));
    evaluations.push_back(static_cast<double>(found.evolution.trace.back().evaluations));
  }
  std::sort(costs.begin(), costs.end());
  std::sort(evaluations.begin(), evaluations.end());
  outcome.error = quantile_of_sorted<double>(costs, 0.5);
  const auto value = [&](double cost) { return objective.higher_is_better ? -cost : cost; };
  outcome.values = {{"objective", value(outcome.error), objective.unit},
                    {"objective_best", value(costs.front()), objective.unit},
                    {"objective_worst", value(costs.back()), objective.unit},
                    {"evaluations", quantile_of_sorted<double>(evaluations, 0.5), "images"}};
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
    search_with_seeds(outcome, setting, objective, scene, conditions, run);
    best = std::min(best, outcome.error);
    time_setting(
        outcome, [&] { optimise_with(setting, quantity, scene, conditions, run.seed); }, run.runs);
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

SweepPlotDesign optimise_sweep_plot(const Objective& objective) {
  return {"objective_excess", objective.quantity + " above the best", objective.unit, {"shrink"}, "search"};
}

}  // namespace plenolab
