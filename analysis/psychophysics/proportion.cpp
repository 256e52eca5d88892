#include "analysis/psychophysics/proportion.h"

#include <fmt/format.h>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "analysis/psychophysics/binomial.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

using Beta = boost::math::beta_distribution<double>;

/// Half of what an interval leaves out.
double tail_of(double confidence) {
  if (!(confidence > 0 && confidence < 1))
    throw InputError(fmt::format("confidence is {} but must lie in (0, 1)", confidence));
  return (1 - confidence) / 2;
}

struct Counts {
  double hits, misses;
};

Counts counts_of(Proportion count) {
  count.validate();
  return {static_cast<double>(count.hits), static_cast<double>(count.trials - count.hits)};
}

Beta posterior(Proportion count, BetaPrior prior) {
  const auto [hits, misses] = counts_of(count);
  if (!(prior.a > 0 && prior.b > 0))
    throw InputError(fmt::format("the prior Beta({}, {}) must have numbers above 0", prior.a, prior.b));
  return {hits + prior.a, misses + prior.b};
}

}  // namespace

void Proportion::validate() const {
  if (trials < 1 || trials > kMostTrials)
    throw InputError(fmt::format("the number of trials is {} but must lie in [1, {}]", trials, kMostTrials));
  if (hits < 0 || hits > trials)
    throw InputError(fmt::format("{} hits in {} trials are not possible", hits, trials));
}

Interval clopper_pearson(Proportion count, double confidence) {
  const double tail = tail_of(confidence);
  const auto [hits, misses] = counts_of(count);
  return {count.rate(), hits == 0 ? 0 : quantile(Beta(hits, misses + 1), tail),
          misses == 0 ? 1 : quantile(complement(Beta(hits + 1, misses), tail))};
}

Interval wilson(Proportion count, double confidence) {
  const double tail = tail_of(confidence);
  count.validate();
  const double z = quantile(complement(boost::math::normal(), tail));
  const double n = static_cast<double>(count.trials), p = count.rate();
  const double centre = p + z * z / (2 * n), shrink = 1 + z * z / n;
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {p, count.hits == 0 ? 0 : (centre - half) / shrink,
          count.hits == count.trials ? 1 : (centre + half) / shrink};
}

Interval jeffreys(Proportion count, double confidence) {
  const double tail = tail_of(confidence);
  const auto [hits, misses] = counts_of(count);
  const Beta beta(hits + 0.5, misses + 0.5);
  return {count.rate(), hits == 0 ? 0 : quantile(beta, tail),
          misses == 0 ? 1 : quantile(complement(beta, tail))};
}

Interval rate_interval(Proportion count, IntervalMethod method, double confidence) {
  switch (method) {
    case IntervalMethod::kWilson:
      return wilson(count, confidence);
    case IntervalMethod::kJeffreys:
      return jeffreys(count, confidence);
    case IntervalMethod::kClopperPearson:
      break;
  }
  return clopper_pearson(count, confidence);
}

double posterior_above(Proportion count, double p, BetaPrior prior) {
  return cdf(complement(posterior(count, prior), p));
}

}  // namespace plenolab
