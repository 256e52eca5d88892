#include "analysis/psychophysics/psychometric_likelihood.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.h"

namespace plenolab::detail {

namespace {

constexpr double kSmallest = 1e-300;

bool is_logarithmic(PsychometricShape shape) {
  return shape == PsychometricShape::kWeibull;
}

}  // namespace

ShapeValue shape_at(PsychometricShape shape, double z) {
  switch (shape) {
    case PsychometricShape::kNormal:
      return {0.5 * std::erfc(-z / std::sqrt(2.0)), 0.5 * std::erfc(z / std::sqrt(2.0)),
              std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi)};
    case PsychometricShape::kLogistic: {
      const double value = 1 / (1 + std::exp(-z)), complement = 1 / (1 + std::exp(z));
      return {value, complement, value * complement};
    }
    case PsychometricShape::kWeibull: {
      const double power = std::exp(std::min(z, 600.0));
      return {-std::expm1(-power), std::exp(-power), power * std::exp(-power)};
    }
  }
  return {0, 1, 0};
}

double standard_quantile(PsychometricShape shape, double share) {
  switch (shape) {
    case PsychometricShape::kNormal:
      return quantile(boost::math::normal(), share);
    case PsychometricShape::kLogistic:
      return std::log(share / (1 - share));
    case PsychometricShape::kWeibull:
      return std::log(-std::log1p(-share));
  }
  return 0;
}

double axis_of(PsychometricShape shape, double x) {
  return is_logarithmic(shape) ? std::log(x) : x;
}

double level_of(PsychometricShape shape, double axis) {
  return is_logarithmic(shape) ? std::exp(axis) : axis;
}

ScaledLevels scaled(std::span<const PsychometricLevel> levels, PsychometricShape shape) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PsychometricLevel& level : levels) {
    level.noticed.validate();
    if (!std::isfinite(level.x)) throw InputError("a level is not a finite number");
    if (is_logarithmic(shape) && !(level.x > 0))
      throw InputError(fmt::format("a Weibull function takes levels above 0, not {:g}", level.x));
    low = std::min(low, axis_of(shape, level.x));
    high = std::max(high, axis_of(shape, level.x));
  }
  if (!std::isfinite(high - low))
    throw InputError("the levels are too far apart for numbers to hold the distance");
  if (!(high > low)) throw InputError("a psychometric function needs at least two different levels");
  ScaledLevels data{{}, 0.5 * (low + high), high - low};
  for (const PsychometricLevel& level : levels)
    data.levels.push_back({(axis_of(shape, level.x) - data.centre) / data.range,
                           static_cast<double>(level.noticed.hits),
                           static_cast<double>(level.noticed.trials - level.noticed.hits)});
  return data;
}

ShapeValue shape_of(const ScaledLevel& level, PsychometricShape shape, const PsychometricParameters& p) {
  return shape_at(shape, (level.u - p.location) * std::exp(-p.log_scale));
}

PsychometricCost cost_of(const ScaledLevels& data, PsychometricShape shape, const PsychometricParameters& p) {
  PsychometricCost cost;
  const double span = 1 - p.guess - p.lapse, inverse_scale = std::exp(-p.log_scale);
  for (const ScaledLevel& level : data.levels) {
    const double z = (level.u - p.location) * inverse_scale;
    const ShapeValue f = shape_at(shape, z);
    const double yes = std::max(kSmallest, p.guess + span * f.value);
    const double no = std::max(kSmallest, p.lapse + span * f.complement);
    if (level.hits > 0) cost.value -= level.hits * std::log(yes);
    if (level.misses > 0) cost.value -= level.misses * std::log(no);
    const double slope = -(level.hits / yes - level.misses / no);
    cost.gradient[0] -= slope * span * f.density * inverse_scale;
    if (f.density > 0) cost.gradient[1] -= slope * span * f.density * z;
    cost.gradient[2] += slope * f.complement;
    cost.gradient[3] -= slope * f.value;
  }
  return cost;
}

double constant_cost(const ScaledLevels& data) {
  double hits = 0, misses = 0;
  for (const ScaledLevel& level : data.levels) hits += level.hits, misses += level.misses;
  const auto part = [&](double count) { return count > 0 ? -count * std::log(count / (hits + misses)) : 0; };
  return part(hits) + part(misses);
}

double saturated_cost(const ScaledLevels& data) {
  double cost = 0;
  for (const ScaledLevel& level : data.levels) {
    const double n = level.hits + level.misses;
    if (level.hits > 0) cost -= level.hits * std::log(level.hits / n);
    if (level.misses > 0) cost -= level.misses * std::log(level.misses / n);
  }
  return cost;
}

}  // namespace plenolab::detail
