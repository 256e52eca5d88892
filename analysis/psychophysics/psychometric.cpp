#include "analysis/psychophysics/psychometric.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/psychometric_likelihood.h"
#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/base/random.h"

namespace plenolab {

using namespace detail;

namespace {

constexpr std::uint64_t kResamplePurpose = 0x7073796368726573;

/// Free rates are written as bound · sin²(v), which reaches both bounds where its slope vanishes.
struct FreeRates {
  bool guess = false, lapse = false;
};

PsychometricParameters parameters_from(const double* x, const PsychometricOptions& options, FreeRates free) {
  PsychometricParameters p{x[0], x[1], options.guess_rate, options.lapse_rate};
  int next = 2;
  const auto rate = [&](double bound) { return bound * std::pow(std::sin(x[next++]), 2); };
  if (free.guess) p.guess = rate(options.most_guess);
  if (free.lapse) p.lapse = rate(options.most_lapse);
  return p;
}

class CostFunction : public ceres::FirstOrderFunction {
 public:
  CostFunction(const ScaledLevels& data, const PsychometricOptions& options, FreeRates free)
      : data_(data), options_(options), free_(free) {}
  int NumParameters() const override { return 2 + (free_.guess ? 1 : 0) + (free_.lapse ? 1 : 0); }
  bool Evaluate(const double* x, double* value, double* gradient) const override {
    const PsychometricCost cost = cost_of(data_, options_.shape, parameters_from(x, options_, free_));
    *value = cost.value;
    if (gradient == nullptr) return std::isfinite(cost.value);
    gradient[0] = cost.gradient[0];
    gradient[1] = cost.gradient[1];
    int next = 2;
    const auto chain = [&](double bound, double derivative) {
      gradient[next] = derivative * bound * std::sin(2 * x[next]);
      ++next;
    };
    if (free_.guess) chain(options_.most_guess, cost.gradient[2]);
    if (free_.lapse) chain(options_.most_lapse, cost.gradient[3]);
    return std::isfinite(cost.value) && std::isfinite(gradient[0]) && std::isfinite(gradient[1]);
  }

 private:
  const ScaledLevels& data_;
  const PsychometricOptions& options_;
  FreeRates free_;
};

struct Solution {
  PsychometricParameters parameters;
  double cost = std::numeric_limits<double>::infinity();
};

Solution solve(const ScaledLevels& data, const PsychometricOptions& options, FreeRates free, double location,
               double log_scale) {
  const ceres::GradientProblem problem(new CostFunction(data, options, free));
  std::array<double, 4> x{location, log_scale, 0.6, 0.6};
  ceres::GradientProblemSolver::Options solver;
  solver.line_search_direction_type = ceres::BFGS;
  solver.max_num_iterations = 300;
  solver.function_tolerance = 1e-15;
  solver.gradient_tolerance = 1e-9;
  solver.parameter_tolerance = 1e-12;
  solver.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(solver, problem, x.data(), &summary);
  const PsychometricParameters found = parameters_from(x.data(), options, free);
  const double cost = cost_of(data, options.shape, found).value;
  return std::isfinite(cost) ? Solution{found, cost} : Solution{};
}

/// The best from all starts. A free rate is also tried at 0, a bound that sin² approaches slowly.
Solution solve_from_all(const ScaledLevels& data, const PsychometricOptions& options,
                        std::span<const std::array<double, 2>> starts) {
  Solution best;
  for (const bool guess : {false, true})
    for (const bool lapse : {false, true}) {
      if ((guess && !options.free_guess) || (lapse && !options.free_lapse)) continue;
      PsychometricOptions at_bound = options;
      if (options.free_guess) at_bound.guess_rate = 0;
      if (options.free_lapse) at_bound.lapse_rate = 0;
      for (const auto& [location, log_scale] : starts) {
        const Solution one = solve(data, at_bound, {guess, lapse}, location, log_scale);
        if (one.cost < best.cost) best = one;
      }
    }
  return best;
}

constexpr std::array<std::array<double, 2>, 6> kStarts{
    {{0, -1.5}, {0, -0.5}, {-0.3, -1.5}, {0.3, -1.5}, {-0.4, -2.5}, {0.4, -2.5}}};

PsychometricStatus status_of(const ScaledLevels& data, const PsychometricOptions& options,
                             const Solution& solution) {
  const PsychometricParameters& p = solution.parameters;
  const bool no_better = solution.cost > constant_cost(data) - 1e-6;
  const bool wide = p.log_scale > std::log(20.0), far = std::abs(p.location) > 10;
  if (no_better || wide || far) return PsychometricStatus::kFlat;
  const auto on_slope = std::count_if(data.levels.begin(), data.levels.end(), [&](const ScaledLevel& level) {
    const ShapeValue f = shape_of(level, options.shape, p);
    return f.value > 1e-6 && f.complement > 1e-6;
  });
  return on_slope <= 1 ? PsychometricStatus::kSeparable : PsychometricStatus::kFitted;
}

/// In the units of the levels.
PsychometricFit fit_from(const ScaledLevels& data, const PsychometricOptions& options,
                         const Solution& solution) {
  const PsychometricParameters& p = solution.parameters;
  PsychometricFit fit;
  fit.options = options;
  fit.status = status_of(data, options, solution);
  const double location = data.centre + data.range * p.location;
  fit.location = level_of(options.shape, location);
  fit.scale = data.range * std::exp(p.log_scale);
  fit.guess_rate = p.guess;
  fit.lapse_rate = p.lapse;
  fit.threshold = psychometric_level(fit, 0.5);
  fit.negative_log_likelihood = solution.cost;
  fit.deviance = std::max(0.0, 2 * (solution.cost - saturated_cost(data)));
  return fit;
}

/// Answers drawn from the fitted function.
ScaledLevels resample(const ScaledLevels& data, const PsychometricOptions& options,
                      const PsychometricParameters& p, std::uint64_t index) {
  RandomStream random(options.seed, kResamplePurpose, index);
  ScaledLevels drawn = data;
  for (ScaledLevel& level : drawn.levels) {
    const ShapeValue f = shape_of(level, options.shape, p);
    const double n = level.hits + level.misses;
    const double share = std::clamp(p.guess + (1 - p.guess - p.lapse) * f.value, 0.0, 1.0);
    // The inverse of the distribution at a uniform number in (0, 1).
    const double tail = std::max(random.next_double(), 0x1p-54);
    level.hits = static_cast<double>(critical_number(static_cast<std::int64_t>(n), share, tail) - 1);
    level.misses = n - level.hits;
  }
  return drawn;
}

Interval percentile_interval(double estimate, std::vector<double>& values, double confidence) {
  std::sort(values.begin(), values.end());
  const std::span<const double> sorted = values;
  const double tail = (1 - confidence) / 2;
  return {estimate, quantile_of_sorted(sorted, tail), quantile_of_sorted(sorted, 1 - tail)};
}

void bootstrap(PsychometricFit& fit, const ScaledLevels& data, const Solution& solution) {
  const PsychometricOptions& options = fit.options;
  const PsychometricParameters& p = solution.parameters;
  const std::array<std::array<double, 2>, 2> starts{{{p.location, p.log_scale}, {0, -1.5}}};
  std::vector<double> thresholds, scales, lapses;
  int larger = 0;
  for (int i = 0; i < options.resamples; ++i) {
    const ScaledLevels drawn = resample(data, options, p, static_cast<std::uint64_t>(i));
    const PsychometricFit one = fit_from(drawn, options, solve_from_all(drawn, options, starts));
    if (one.status != PsychometricStatus::kFitted) {
      ++fit.degenerate_resamples;
      continue;
    }
    thresholds.push_back(one.threshold);
    scales.push_back(one.scale);
    lapses.push_back(one.lapse_rate);
    larger += one.deviance >= fit.deviance ? 1 : 0;
  }
  if (thresholds.size() < 50) return;  // too few for an interval
  fit.deviance_p = static_cast<double>(larger) / static_cast<double>(thresholds.size());
  fit.threshold_interval = percentile_interval(fit.threshold, thresholds, options.confidence);
  fit.scale_interval = percentile_interval(fit.scale, scales, options.confidence);
  if (options.free_lapse)
    fit.lapse_interval = percentile_interval(fit.lapse_rate, lapses, options.confidence);
}

}  // namespace

void PsychometricOptions::validate() const {
  const auto require = [](bool holds, const char* what, double value, const char* range) {
    if (!holds) throw InputError(fmt::format("the {} is {:g} but must lie in {}", what, value, range));
  };
  require(guess_rate >= 0 && guess_rate < 1, "guess rate", guess_rate, "[0, 1)");
  require(lapse_rate >= 0 && guess_rate + lapse_rate < 1, "lapse rate", lapse_rate, "[0, 1 − guess rate)");
  require(most_guess > 0 && most_guess < 1, "largest guess rate", most_guess, "(0, 1)");
  const double guess = free_guess ? most_guess : guess_rate;
  require(most_lapse > 0 && guess + most_lapse < 1, "largest lapse rate", most_lapse, "(0, 1 − guess rate)");
  require(confidence > 0 && confidence < 1, "confidence", confidence, "(0, 1)");
  require(resamples == 0 || resamples >= 100, "number of resamples", resamples, "{0} or [100, ∞)");
}

PsychometricFit fit_psychometric(std::span<const PsychometricLevel> levels,
                                 const PsychometricOptions& options) {
  options.validate();
  const ScaledLevels data = scaled(levels, options.shape);
  const Solution solution = solve_from_all(data, options, kStarts);
  if (!std::isfinite(solution.cost))
    throw InputError("no psychometric function gives these answers a probability above 0");
  PsychometricFit fit = fit_from(data, options, solution);
  if (options.resamples > 0 && fit.status == PsychometricStatus::kFitted) bootstrap(fit, data, solution);
  return fit;
}

double psychometric_value(const PsychometricFit& fit, double x) {
  const PsychometricShape shape = fit.options.shape;
  const double z = (axis_of(shape, x) - axis_of(shape, fit.location)) / fit.scale;
  return fit.guess_rate + (1 - fit.guess_rate - fit.lapse_rate) * shape_at(shape, z).value;
}

double psychometric_level(const PsychometricFit& fit, double share) {
  if (!(share > 0 && share < 1))
    throw InputError(fmt::format("a share of the rise is {:g} but must lie in (0, 1)", share));
  const PsychometricShape shape = fit.options.shape;
  const double axis = axis_of(shape, fit.location) + fit.scale * standard_quantile(shape, share);
  return level_of(shape, axis);
}

std::string status_text(PsychometricStatus status) {
  switch (status) {
    case PsychometricStatus::kFitted:
      return "";
    case PsychometricStatus::kSeparable:
      return "at most one level lies on the slope: a step fits as well, so the scale is not determined; add "
             "levels between the highest that is never and the lowest that is always noticed";
    case PsychometricStatus::kFlat:
      return "the answers do not rise over the levels: neither threshold nor scale is determined";
  }
  return "";
}

}  // namespace plenolab
