#pragma once

#include <array>
#include <span>
#include <vector>

#include "analysis/psychophysics/psychometric.h"

namespace plenolab::detail {

/// F, 1 − F and the density at z of a location-scale family; Weibull is one in log x.
struct ShapeValue {
  double value = 0, complement = 1, density = 0;
};
ShapeValue shape_at(PsychometricShape shape, double z);
/// Standard place z at which F has the value `share` in (0, 1).
double standard_quantile(PsychometricShape shape, double share);

/// The axis on which the shape has location and scale: x, or log x (Weibull); and back.
double axis_of(PsychometricShape shape, double x);
double level_of(PsychometricShape shape, double axis);

/// Parameters in the units of the fit: levels are shifted and scaled to [−½, ½].
struct PsychometricParameters {
  double location = 0, log_scale = 0, guess = 0, lapse = 0;
};

struct ScaledLevel {
  double u = 0, hits = 0, misses = 0;
};

/// Levels in the units of the fit, with what turns them back: axis = centre + range · u.
struct ScaledLevels {
  std::vector<ScaledLevel> levels;
  double centre = 0, range = 1;
};
/// Throws InputError for fewer than two different levels, or levels that the shape does not take.
ScaledLevels scaled(std::span<const PsychometricLevel> levels, PsychometricShape shape);

/// F of a level.
ShapeValue shape_of(const ScaledLevel& level, PsychometricShape shape, const PsychometricParameters& p);

/// −log L with its derivatives by location, log scale, γ and λ.
struct PsychometricCost {
  double value = 0;
  std::array<double, 4> gradient{};
};
PsychometricCost cost_of(const ScaledLevels& data, PsychometricShape shape, const PsychometricParameters& p);

/// −log L of the best constant share, which a function that does not rise reaches, and of the observed
/// shares.
double constant_cost(const ScaledLevels& data);
double saturated_cost(const ScaledLevels& data);

}  // namespace plenolab::detail
