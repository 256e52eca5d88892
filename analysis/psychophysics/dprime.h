#pragma once

#include "analysis/psychophysics/proportion.h"

namespace plenolab {

/// Sensitivity d′: the distance of two stimuli in standard deviations of what an observer senses
/// (Macmillan & Creelman 2005). Chapters and names as there.

/// What the observer is taken to do with two intervals, or with a reference and two.
enum class DprimeModel {
  kTwoAlternatives,  ///< 2AFC/2IFC, "which is the stronger?": the better of two independent samples
  kAbxIndependent,   ///< matching to sample, likelihood of all samples (independent observations)
  kAbxDifferencing,  ///< matching to sample, the comparison nearer to the reference
};

/// Share of correct answers without bias: ½ for d′ = 0, rising to 1. `dprime` ≥ 0.
double proportion_correct(double dprime, DprimeModel model);

/// The inverse. Shares of ½ and below give 0 (negative values only for kTwoAlternatives); 1 gives infinity.
double dprime_of(double proportion_correct, DprimeModel model);

/// (hits + ½)/(trials + 1): keeps d′ finite where all or no answers are right (log-linear rule, Hautus 1995).
double log_linear_rate(Proportion count);

/// d′ of a count of correct answers with the ends of its Clopper-Pearson interval, which may be infinite. The
/// estimate uses the log-linear rule if wanted.
Interval dprime_interval(Proportion correct, DprimeModel model, bool log_linear = true,
                         double confidence = 0.95);

/// Yes/no: hits among signal trials, false alarms among noise trials.
struct YesNoSensitivity {
  Interval dprime;       ///< normal approximation (Gourevitch & Galanter 1967)
  double criterion = 0;  ///< c; above 0: says yes too rarely
  /// The share of correct answers that an unbiased observer of this sensitivity would reach in the matching
  /// task whose answers "first"/"second" were counted as hits and false alarms: Φ((z(H) − z(F))/2).
  double unbiased_share = 0.5;
};
YesNoSensitivity yes_no_sensitivity(Proportion hits, Proportion false_alarms, bool log_linear = true,
                                    double confidence = 0.95);

}  // namespace plenolab
