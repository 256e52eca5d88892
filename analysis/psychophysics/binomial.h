#pragma once

#include <cstdint>

namespace plenolab {

/// The binomial distribution of `trials` independent trials with success probability `p`: probabilities,
/// tails and the critical number of a test, for up to 10⁹ trials and p as near to 0 and 1 as double has
/// numbers. Everything is computed as a logarithm, so that nothing under- or overflows; relative errors are
/// below 1e-9. All functions throw InputError for trials outside [0, 10⁹] or p outside [0, 1].

inline constexpr std::int64_t kMostTrials = 1'000'000'000;

/// Natural logarithm of P(X = hits); −∞ for hits outside [0, trials]. By Loader's saddle-point expansion
/// (Loader 2000, "Fast and accurate computation of binomial probabilities").
double log_binomial_probability(std::int64_t hits, std::int64_t trials, double p);

/// Natural logarithm of P(X ≥ hits): 0 for hits ≤ 0, −∞ for hits > trials.
double log_upper_tail(std::int64_t hits, std::int64_t trials, double p);
/// Natural logarithm of P(X ≤ hits).
double log_lower_tail(std::int64_t hits, std::int64_t trials, double p);

/// P(X ≥ hits) and P(X ≤ hits): the p values of the one-sided exact tests.
double upper_tail(std::int64_t hits, std::int64_t trials, double p);
double lower_tail(std::int64_t hits, std::int64_t trials, double p);

/// p value of the two-sided exact test: all counts that are no more probable than `hits` (R's binom.test).
double two_sided_p(std::int64_t hits, std::int64_t trials, double p);

/// i_c(n, p) = min{ i : P(X ≥ i) < alpha } (Hansen & Klein 2016, eq. 4.2): the smallest count that refutes a
/// rate of at most p. It is trials + 1 where even a success in every trial would not. A tail that equals
/// alpha but for rounding (1e-12 relative) is not below it. `alpha` in (0, 1).
std::int64_t critical_number(std::int64_t trials, double p, double alpha = 0.05);

}  // namespace plenolab
