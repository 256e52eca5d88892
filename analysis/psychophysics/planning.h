#pragma once

#include <cstdint>
#include <vector>

#include "analysis/psychophysics/equivalence.h"

namespace plenolab {

/// How many trials a study needs. Power of exact tests does not rise steadily with the number of trials: it
/// falls back whenever the critical number grows by one (a sawtooth).

/// Probability that a test of "the rate is at most p_null" succeeds, i.e. that at least i_c trials hit, if
/// the rate is `p_true`.
double test_power(std::int64_t trials, double p_null, double p_true, double alpha = 0.05);

struct SampleSize {
  std::int64_t first = 0;   ///< the smallest number of trials with the power wanted
  std::int64_t stable = 0;  ///< the smallest from which every larger number has it too: the one to plan with
};

struct TestPlan {
  double p_null = 0.19;
  double p_true = 0.5;  ///< > p_null
  double alpha = 0.05;
  double power = 0.8;  ///< in (0, 1)

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// Exact: every number of trials is tried, up to one from which Hoeffding's inequality guarantees the power.
/// Throws InputError if that is above 10⁶ trials (p_true too near p_null).
SampleSize plan_test(const TestPlan& plan);

/// The same for a test of equivalence if the rate is `p_true`, which must lie within the margin.
SampleSize plan_equivalence(const EquivalenceOptions& options, double p_true = 0.5, double power = 0.8);

/// Power for every number of trials from 1 to `most`, the sawtooth to plot; entry i is for i + 1 trials.
std::vector<double> power_curve(double p_null, double p_true, double alpha, std::int64_t most);

}  // namespace plenolab
