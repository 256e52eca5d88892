#pragma once

#include <cstdint>

#include "analysis/statistics.h"

namespace plenolab {

/// Hits among independent trials.
struct Proportion {
  std::int64_t hits = 0, trials = 0;

  double rate() const { return static_cast<double>(hits) / static_cast<double>(trials); }
  /// Throws InputError unless 0 ≤ hits ≤ trials, 1 ≤ trials ≤ 10⁹.
  void validate() const;
};

/// Two-sided intervals of the rate; the estimate is hits/trials. `confidence` in (0, 1).
/// Clopper & Pearson 1934: covers at least as often as promised; the one to state.
Interval clopper_pearson(Proportion count, double confidence = 0.95);
/// Wilson 1927, the score interval: shorter, covers as promised on average.
Interval wilson(Proportion count, double confidence = 0.95);
/// Equal-tailed interval of the posterior under Jeffreys' prior Beta(½, ½); an end is 0 or 1 where no or all
/// trials hit (Brown, Cai & DasGupta 2001).
Interval jeffreys(Proportion count, double confidence = 0.95);

enum class IntervalMethod { kClopperPearson, kWilson, kJeffreys };
Interval rate_interval(Proportion count, IntervalMethod method, double confidence = 0.95);

/// A Beta(a, b) prior of the rate; (1, 1) is uniform.
struct BetaPrior {
  double a = 1, b = 1;  ///< > 0
};

/// Probability, given the count, that the rate is above `p`.
double posterior_above(Proportion count, double p, BetaPrior prior = {});

}  // namespace plenolab
