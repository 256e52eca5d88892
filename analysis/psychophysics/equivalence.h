#pragma once

#include <cstdint>

#include "analysis/psychophysics/proportion.h"

namespace plenolab {

/// Two one-sided exact tests (TOST, Schuirmann 1987): do counts show that a rate lies within
/// centre ± margin? That a test of difference finds nothing does not show it.
struct EquivalenceOptions {
  double centre = 0.5;   ///< the rate of guessing
  double margin = 0.15;  ///< > 0; centre ± margin within [0, 1]
  double alpha = 0.05;   ///< of each one-sided test, in (0, 1)

  double low() const { return centre - margin; }
  double high() const { return centre + margin; }
  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// The larger p value of the two tests: equivalence is shown where it is below alpha.
double equivalence_p(Proportion count, const EquivalenceOptions& options = {});

/// Counts that show equivalence: low ≤ hits ≤ high. Empty where no count of so few trials can.
struct EquivalenceRegion {
  std::int64_t low = 0, high = -1;

  bool empty() const { return low > high; }
  bool contains(std::int64_t hits) const { return hits >= low && hits <= high; }
};
EquivalenceRegion equivalence_region(std::int64_t trials, const EquivalenceOptions& options = {});

/// Probability that the test shows equivalence if the rate is `p`.
double equivalence_power(std::int64_t trials, double p, const EquivalenceOptions& options = {});

}  // namespace plenolab
