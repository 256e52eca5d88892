#include "core/tonemap/adaptation.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

/// (1 − e^(−x))/x, 1 at 0, 0 at ∞.
double mean_decay(double x) {
  if (x == 0) return 1;
  return std::isinf(x) ? 0 : -std::expm1(-x) / x;
}

double step(const AdaptationWeights& w, double state, double previous_target, double target) {
  // Written as differences to the target, so that a target equal to the state is kept exactly.
  return target + w.state * (state - target) + w.previous_target * (previous_target - target);
}

ImageStatistics step(const AdaptationWeights& w, const Adapted<ImageStatistics>& before,
                     const ImageStatistics& target) {
  const ImageStatistics &s = before.value, &p = before.target;
  const auto follow = [&](auto member) { return step(w, s.*member, p.*member, target.*member); };
  ImageStatistics out;
  for (std::size_t i = 0; i < 3; ++i)
    out.average_colour[i] = step(w, s.average_colour[i], p.average_colour[i], target.average_colour[i]);
  out.average_luminance = follow(&ImageStatistics::average_luminance);
  out.log_average = follow(&ImageStatistics::log_average);
  out.log_min = follow(&ImageStatistics::log_min);
  out.log_max = follow(&ImageStatistics::log_max);
  out.log_p1 = follow(&ImageStatistics::log_p1);
  out.log_p99 = follow(&ImageStatistics::log_p99);
  out.log_robust_average = follow(&ImageStatistics::log_robust_average);
  return out;
}

}  // namespace

void AdaptationOptions::validate() const {
  if (!(time_constant_s >= 0) || std::isinf(time_constant_s))
    throw InputError(
        fmt::format("the time constant of adaptation must be finite and ≥ 0 s, not {}", time_constant_s));
}

AdaptationWeights adaptation_weights(const AdaptationOptions& options, double step_s) {
  options.validate();
  if (!(step_s >= 0)) throw InputError(fmt::format("a time step must be ≥ 0 s, not {}", step_s));
  if (options.time_constant_s == 0) return {0, 0, 1};
  const double x = step_s / options.time_constant_s;
  if (options.scheme == AdaptationScheme::kExplicitEuler) return {1 - x, 0, x};
  const double w = std::exp(-x);
  if (options.scheme == AdaptationScheme::kHeldTarget) return {w, 0, -std::expm1(-x)};
  const double mean = mean_decay(x);
  return {w, mean - w, 1 - mean};
}

Adapted<double> adapt(const AdaptationOptions& options, const std::optional<Adapted<double>>& previous,
                      double target, double step_s) {
  const AdaptationWeights w = adaptation_weights(options, step_s);
  if (!previous) return {target, target};
  return {step(w, previous->value, previous->target, target), target};
}

Adapted<ImageStatistics> adapt(const AdaptationOptions& options,
                               const std::optional<Adapted<ImageStatistics>>& previous,
                               const ImageStatistics& target, double step_s) {
  const AdaptationWeights w = adaptation_weights(options, step_s);
  if (!previous) return {target, target};
  return {step(w, *previous, target), target};
}

}  // namespace plenolab
