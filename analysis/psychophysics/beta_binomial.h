#pragma once

#include <span>

#include "analysis/psychophysics/proportion.h"

namespace plenolab {

/// Participants differ: some see a difference that others do not, and trials of one participant are alike.
/// Each participant's rate is drawn from a Beta distribution with mean `rate`; `overdispersion` ρ in [0, 1)
/// is the correlation of two trials of one participant: 0 = all alike (binomial), 1 = each always or never.
/// All trials must be of one image: over images with different rates see participant_effect.h.

struct BetaBinomialFit {
  Interval rate;            ///< maximum likelihood and profile-likelihood interval
  Interval overdispersion;  ///< the same; [0, 1] where `identified` is false
  /// Whether the data can tell ρ: some participant has two trials, and not all trials have the same answer.
  bool identified = true;
  double log_likelihood = 0;           ///< without binomial coefficients
  double binomial_log_likelihood = 0;  ///< at ρ = 0
  double p_overdispersed = 1;  ///< likelihood-ratio test of ρ = 0, which lies on the edge (½χ²₁)
  /// Variance of the pooled rate over that of as many independent trials: divide the trials by it.
  double design_effect = 1;
};

/// Maximum likelihood over participants (Griffiths 1973; profile likelihood for the intervals). Throws
/// InputError for no participants.
BetaBinomialFit fit_beta_binomial(std::span<const Proportion> participants, double confidence = 0.95);

/// log-likelihood without binomial coefficients. rate in (0, 1), overdispersion in [0, 1).
double beta_binomial_log_likelihood(std::span<const Proportion> participants, double rate,
                                    double overdispersion);

/// Posterior probability that the mean rate is above `p`, for uniform priors of rate and overdispersion:
/// unlike the binomial one it allows for participants who differ. By summation over a grid.
double beta_binomial_posterior_above(std::span<const Proportion> participants, double p);

}  // namespace plenolab
