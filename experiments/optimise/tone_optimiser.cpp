#include "experiments/optimise/tone_optimiser.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/statistics.h"

namespace plenolab {

namespace {

ImageStatistics statistics_of(const SceneImage& image, int threads) {
  const ViewStatistics measured = measure_view(image, threads);
  return evaluate(measured, log_floor(measured));
}

/// Costs of candidates, as many at once as there are threads.
ScoreAll scores_of(const SceneImage& scene, const Objective& objective, const ImageStatistics& statistics,
                   int threads) {
  return [&scene, &objective, statistics, threads](std::span<const std::vector<double>> candidates) {
    std::vector<double> costs(candidates.size());
    parallel_for(static_cast<int>(candidates.size()), 1, threads, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const ToneMapped mapped = apply(fit(generic_options(candidates[k]), statistics), scene, 1);
        costs[k] = objective.cost(objective.measure(mapped.image));
      }
    });
    return costs;
  };
}

/// Conditions for the objective of the smaller image while candidates are evaluated side by side.
ComparisonConditions search_conditions(ComparisonConditions conditions,
                                       const ToneOptimisationOptions& options) {
  conditions.threads = 1;
  if (!describe_objective(options.quantity).viewing) return conditions;
  const double full_size = conditions.viewing.pixels_per_degree;
  conditions.viewing.pixels_per_degree /= static_cast<double>(options.shrink);
  if (conditions.viewing.pixels_per_degree < 1)
    throw InputError(
        fmt::format("an image of {:g} pixels per degree cannot be shrunk by {}: less than 1 would "
                    "be left",
                    full_size, options.shrink));
  return conditions;
}

}  // namespace

void ToneOptimisationOptions::validate() const {
  evolution.validate();
  if (shrink < 1 || shrink > 64)
    throw InputError(fmt::format("the image is shrunk by {} but that must lie in [1, 64]", shrink));
}

std::vector<SearchParameter> generic_search_space() {
  const std::vector<double> start = parameters_of({});
  return {{"b", start[0], -2, 2},    {"d_l", start[1], 0.001, 2.5}, {"d_h", start[2], 0.001, 2.5},
          {"c", start[3], 0.2, 1.5}, {"m1", start[4], -2, 2},       {"m2", start[5], -2, 2},
          {"m3", start[6], -2, 2}};
}

GenericOptions generic_options(std::span<const double> p) {
  PLENOLAB_CHECK(p.size() == 7, fmt::format("{} parameters", p.size()));
  GenericOptions options;
  options.brightness = p[0];
  options.low_range = p[1];
  options.high_range = p[2];
  options.contrast = p[3];
  options.fine = p[4];
  options.middle = p[5];
  options.coarse = p[6];
  return options;
}

std::vector<double> parameters_of(const GenericOptions& o) {
  return {o.brightness, o.low_range, o.high_range, o.contrast, o.fine, o.middle, o.coarse};
}

SceneImage averaged_down(const SceneImage& image, int shrink) {
  if (shrink == 1) return image;
  SceneImage small((image.width() + shrink - 1) / shrink, (image.height() + shrink - 1) / shrink);
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x) {
      const int right = std::min((x + 1) * shrink, image.width());
      const int below = std::min((y + 1) * shrink, image.height());
      Rgb sum;
      for (int v = y * shrink; v < below; ++v)
        for (int u = x * shrink; u < right; ++u) sum += image.at(u, v);
      small.at(x, y) = sum * (1 / static_cast<float>((right - x * shrink) * (below - y * shrink)));
    }
  return small;
}

ToneOptimisation optimise_tones(const SceneImage& scene, const ComparisonConditions& conditions,
                                const ToneOptimisationOptions& options,
                                const std::function<void(const EvolutionStep&)>& progress) {
  options.validate();
  PLENOLAB_CHECK(conditions.valid == nullptr, "a mask does not fit the size of the search");
  const RepairedView repaired(scene, conditions.threads);
  const SceneImage& full = repaired.image();
  const Stopwatch watch;
  const SceneImage small = averaged_down(full, options.shrink);
  const Objective objective = make_objective(options.quantity, small, search_conditions(conditions, options));
  ToneOptimisation result;
  result.repairs = repaired.repairs();
  result.evolution = minimise_by_evolution(
      generic_search_space(),
      scores_of(small, objective, statistics_of(small, conditions.threads), conditions.threads),
      options.evolution, progress);
  result.seconds_search = watch.seconds();
  result.best = generic_options(result.evolution.best);
  result.best.band_scale = options.shrink;  // the bands that the search saw
  const Objective at_full_size = make_objective(options.quantity, full, conditions);
  const ImageStatistics statistics = statistics_of(full, conditions.threads);
  DisplayImage start = apply(fit(GenericOptions{}, statistics), full, conditions.threads).image;
  result.start_value = at_full_size.measure(start);
  result.image = apply(fit(result.best, statistics), full, conditions.threads).image;
  result.best_value = result.found_value = at_full_size.measure(result.image);
  if (at_full_size.cost(result.found_value) > at_full_size.cost(result.start_value)) {
    result.start_kept = true;
    result.best = {};
    result.best_value = result.start_value;
    result.image = std::move(start);
  }
  return result;
}

}  // namespace plenolab
