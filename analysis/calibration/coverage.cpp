#include "analysis/calibration/coverage.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/random.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kRigs = 0x63616c6962726967ull;
constexpr int kGrain = 16;

/// What coverage needs of one fit.
struct RigOutcome {
  bool converged = false;
  std::array<std::optional<CalibrationEstimate>, kCalibrationParameters> determined;
};

RigOutcome outcome_of(const CalibrationRig& rig, const CoverageOptions& options, int number) {
  const std::uint64_t seed = random_u64(options.seed, kRigs, static_cast<std::uint64_t>(number));
  const CalibrationFit fit = fit_calibration(simulate_measurements(rig, seed), options.fit);
  RigOutcome outcome{fit.converged, {}};
  for (std::size_t i = 0; i < outcome.determined.size(); ++i)
    if (fit.converged && fit.uncertainty.parameters[i].determined())
      outcome.determined[i] = fit.uncertainty.parameters[i];
  return outcome;
}

ParameterCoverage cover(const std::vector<RigOutcome>& outcomes, std::size_t parameter, double truth) {
  ParameterCoverage c;
  c.parameter = static_cast<CalibrationParameter>(parameter);
  double squares = 0;
  for (const RigOutcome& outcome : outcomes) {
    const auto& estimate = outcome.determined[parameter];
    if (!estimate) continue;
    const double error = estimate->value - truth;
    ++c.fits;
    c.covered += estimate->low() <= truth && truth <= estimate->high();
    squares += error * error;
    c.mean_error += error;
    c.mean_sd += *estimate->sd;
  }
  if (c.fits == 0) return c;
  c.rms_error = std::sqrt(squares / c.fits);
  c.mean_error /= c.fits;
  c.mean_sd /= c.fits;
  return c;
}

}  // namespace

void CoverageOptions::validate() const {
  if (rigs < 1) throw InputError(fmt::format("coverage takes at least one simulated rig, not {}", rigs));
  fit.validate();
}

CoverageResult measure_coverage(const CalibrationRig& rig, const CoverageOptions& options) {
  options.validate();
  rig.validate("rig");
  const Stopwatch watch;
  std::vector<RigOutcome> outcomes(static_cast<std::size_t>(options.rigs));
  parallel_for(options.rigs, kGrain, options.threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) outcomes[static_cast<std::size_t>(i)] = outcome_of(rig, options, i);
  });
  CoverageResult result;
  result.rigs = options.rigs;
  for (const RigOutcome& outcome : outcomes) result.converged += outcome.converged;
  for (std::size_t i = 0; i < kCalibrationParameters; ++i)
    if (rig.plan.parameters[i].role != ParameterSetting::Role::kFixed)
      result.parameters.push_back(cover(outcomes, i, rig.truth[i]));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plenolab
