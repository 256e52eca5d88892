#include "experiments/optimise/objective.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "experiments/score.h"
#include "metrics/feature_distortion.h"
#include "metrics/viewing_conditions.h"

namespace plenolab {

namespace {

bool takes_mapped(const Metric& metric) {
  return metric.compare_mapped || metric.judge;
}

bool has_direction(const MetricQuantity& quantity) {
  return quantity.better == Better::kHigher || quantity.better == Better::kLower;
}

/// The metric of a quantity, and the quantity; both null if there is none.
std::pair<const Metric*, const MetricQuantity*> find_quantity(const std::string& name) {
  for (const Metric& metric : metrics())
    if (takes_mapped(metric))
      for (const MetricQuantity& quantity : metric.quantities)
        if (quantity.name == name && has_direction(quantity)) return {&metric, &quantity};
  return {nullptr, nullptr};
}

/// The features of the scene's photographs cost more than those of one tone mapped image and are the same for
/// all of them.
std::function<double(const DisplayImage&)> feature_measure(const SceneImage& scene,
                                                           const ComparisonConditions& conditions,
                                                           bool content_adaptive) {
  FeatureOptions options;
  if (content_adaptive) options.photograph = content_adaptive_photograph;
  const Plane<float> luminance =
      content_adaptive ? scene_luminance(scene, conditions.cd_m2_per_unit) : relative_luminance(scene);
  const auto reference = std::make_shared<const FeatureReference>(
      feature_reference(luminance, options, conditions.valid, conditions.threads));
  return [reference, options, valid = conditions.valid](const DisplayImage& mapped) {
    return feature_distortion(mapped, *reference, options, valid).total;
  };
}

}  // namespace

std::vector<std::string> objective_quantities() {
  std::vector<std::string> names;
  for (const Metric& metric : metrics())
    if (takes_mapped(metric))
      for (const MetricQuantity& quantity : metric.quantities)
        if (has_direction(quantity)) names.push_back(quantity.name);
  return names;
}

Objective describe_objective(const std::string& quantity) {
  const auto [metric, found] = find_quantity(quantity);
  if (!found)
    throw InputError(fmt::format("there is no quantity '{}' to optimise; choose one of {}", quantity,
                                 fmt::join(objective_quantities(), ", ")));
  return {.quantity = found->name,
          .unit = found->unit,
          .higher_is_better = found->better == Better::kHigher,
          .viewing = metric->viewing,
          .absolute_luminance = metric->absolute_luminance};
}

Objective make_objective(const std::string& quantity, const SceneImage& scene,
                         const ComparisonConditions& conditions) {
  Objective objective = describe_objective(quantity);
  if (quantity == "feature_photographic" || quantity == "feature_content_adaptive") {
    objective.measure = feature_measure(scene, conditions, quantity == "feature_content_adaptive");
    return objective;
  }
  const Metric* metric = find_quantity(quantity).first;
  objective.measure = [metric, quantity, &scene, conditions](const DisplayImage& mapped) {
    return value_of(measure(mapped, scene, {metric}, conditions), quantity);
  };
  return objective;
}

}  // namespace plenolab
