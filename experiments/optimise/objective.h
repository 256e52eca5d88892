#pragma once

#include <functional>
#include <string>
#include <vector>

#include "metrics/table.h"

namespace plenolab {

/// What tone mapping is optimised for: one number of a metric that compares a tone mapped image with its
/// scene, or that judges it alone.
struct Objective {
  std::string quantity, unit;
  bool higher_is_better = false;
  bool viewing = false;             ///< whether the number depends on the viewing conditions
  bool absolute_luminance = false;  ///< whether it means nothing without the scale of the scene
  /// The number as the metric reports it. May be called from several threads at once.
  std::function<double(const DisplayImage& mapped)> measure;

  /// For minimising: lower is better.
  double cost(double value) const { return higher_is_better ? -value : value; }
};

/// Quantities there are to choose from: those whose better values are higher or lower.
std::vector<std::string> objective_quantities();

/// The objective without its measure: what its numbers mean. Throws as make_objective does.
Objective describe_objective(const std::string& quantity);

/// What does not depend on the tone mapped image is prepared here. `scene` must outlive the objective. Throws
/// InputError listing what there is for an unknown quantity.
Objective make_objective(const std::string& quantity, const SceneImage& scene,
                         const ComparisonConditions& conditions);

}  // namespace plenolab
