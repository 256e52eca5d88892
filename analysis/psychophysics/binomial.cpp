#include "analysis/psychophysics/binomial.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/psychophysics/beta_fraction.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check(std::int64_t trials, double p) {
  if (trials < 0 || trials > kMostTrials)
    throw InputError(fmt::format("the number of trials is {} but must lie in [0, {}]", trials, kMostTrials));
  if (!(p >= 0 && p <= 1)) throw InputError(fmt::format("the probability is {} but must lie in [0, 1]", p));
}

/// log(n!) − log(√(2πn) (n/e)^n), the error of Stirling's formula.
double stirling_error(double n) {
  if (n < 16) return std::lgamma(n + 1) - (n + 0.5) * std::log(n) + n - 0.5 * std::log(2 * std::numbers::pi);
  const double nn = n * n;
  return (1.0 / 12 - (1.0 / 360 - (1.0 / 1260 - (1.0 / 1680 - 1.0 / 1188 / nn) / nn) / nn) / nn) / n;
}

/// x log(x/m) + m − x without cancellation where x is near m (Loader's deviance term).
double deviance_term(double x, double m) {
  const double difference = x - m;
  if (std::abs(difference) >= 0.1 * (x + m)) return x * std::log(x / m) - difference;
  const double v = difference / (x + m), v2 = v * v;
  double sum = difference * v, term = 2 * x * v;
  for (int j = 1; j < 1000; ++j) {
    term *= v2;
    const double next = sum + term / (2 * j + 1);
    if (next == sum) break;
    sum = next;
  }
  return sum;
}

/// log P(X = k) for 0 ≤ k ≤ n and 0 < p < 1; q = 1 − p.
double log_probability(double k, double n, double p, double q) {
  const double log_q = p < 0.5 ? std::log1p(-p) : std::log(q);
  if (k == 0) return n * log_q;
  if (k == n) return n * (q < 0.5 ? std::log1p(-q) : std::log(p));
  const double exponent = stirling_error(n) - stirling_error(k) - stirling_error(n - k) -
                          deviance_term(k, n * p) - deviance_term(n - k, n * q);
  return exponent - 0.5 * (std::log(2 * std::numbers::pi) + std::log(k) + std::log((n - k) / n));
}

/// log P(X ≥ k) where the tail holds less than about half: 1 ≤ k ≤ n, 0 < p < 1.
double log_small_tail(double k, double n, double p, double q) {
  const double log_q = p < 0.5 ? std::log1p(-p) : std::log(q);
  return log_probability(k, n, p, q) + log_q + std::log(detail::beta_fraction(k, n - k + 1, p, q));
}

double log_tail(std::int64_t hits, std::int64_t trials, double p, double q) {
  if (hits <= 0) return 0;
  if (hits > trials || p == 0) return -kInfinity;
  if (q == 0) return 0;
  const double k = static_cast<double>(hits), n = static_cast<double>(trials);
  if (p < (k + 1) / (n + 3)) return std::min(0.0, log_small_tail(k, n, p, q));
  // The other tail, X ≤ k − 1, seen from the failures.
  const double other = std::exp(log_small_tail(n - k + 1, n, q, p));
  return other < 1 ? std::log1p(-other) : -kInfinity;
}

/// The first number in (low, high] that `holds`: it must hold at `high` and not at `low`, and change once.
template <class Predicate>
std::int64_t first_that(std::int64_t low, std::int64_t high, const Predicate& holds) {
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

/// Where the normal approximation puts the quantile of the upper tail.
std::int64_t guess_critical_number(std::int64_t trials, double p, double alpha) {
  const double n = static_cast<double>(trials);
  const double tail = std::clamp(alpha, 1e-300, 1 - 1e-15);
  const double z = quantile(boost::math::complement(boost::math::normal(), tail));
  const double guess = n * p + z * std::sqrt(n * p * (1 - p)) + 1;
  return static_cast<std::int64_t>(std::clamp(guess, 0.0, n + 1));
}

}  // namespace

double log_binomial_probability(std::int64_t hits, std::int64_t trials, double p) {
  check(trials, p);
  if (hits < 0 || hits > trials) return -kInfinity;
  if (p == 0) return hits == 0 ? 0 : -kInfinity;
  if (p == 1) return hits == trials ? 0 : -kInfinity;
  return log_probability(static_cast<double>(hits), static_cast<double>(trials), p, 1 - p);
}

double log_upper_tail(std::int64_t hits, std::int64_t trials, double p) {
  check(trials, p);
  return log_tail(hits, trials, p, 1 - p);
}

double log_lower_tail(std::int64_t hits, std::int64_t trials, double p) {
  check(trials, p);
  return log_tail(trials - hits, trials, 1 - p, p);
}

double upper_tail(std::int64_t hits, std::int64_t trials, double p) {
  return std::exp(log_upper_tail(hits, trials, p));
}

double lower_tail(std::int64_t hits, std::int64_t trials, double p) {
  return std::exp(log_lower_tail(hits, trials, p));
}

double two_sided_p(std::int64_t hits, std::int64_t trials, double p) {
  check(trials, p);
  if (hits < 0 || hits > trials)
    throw InputError(fmt::format("{} hits in {} trials are not possible", hits, trials));
  // R's tolerance: counts whose probabilities are equal but for rounding are equally extreme.
  const double limit = log_binomial_probability(hits, trials, p) + 1e-7;
  if (p == 0 || p == 1) return limit > -1 ? 1 : 0;
  const double mean = static_cast<double>(trials) * p;
  const auto mode = static_cast<std::int64_t>((static_cast<double>(trials) + 1) * p);
  const auto rarer = [&](std::int64_t k) { return log_binomial_probability(k, trials, p) <= limit; };
  if (static_cast<double>(hits) == mean) return 1;
  if (static_cast<double>(hits) < mean) {
    const std::int64_t from = first_that(std::min(mode, trials), trials + 1, rarer);
    return std::min(1.0, lower_tail(hits, trials, p) + upper_tail(from, trials, p));
  }
  const std::int64_t to = -first_that(-std::min(mode, trials), 1, [&](std::int64_t k) { return rarer(-k); });
  return std::min(1.0, upper_tail(hits, trials, p) + lower_tail(to, trials, p));
}

std::int64_t critical_number(std::int64_t trials, double p, double alpha) {
  check(trials, p);
  if (!(alpha > 0 && alpha < 1)) throw InputError(fmt::format("alpha is {} but must lie in (0, 1)", alpha));
  const double limit = std::log(alpha) - 1e-12;
  const auto below = [&](std::int64_t i) { return log_tail(i, trials, p, 1 - p) < limit; };
  std::int64_t low = guess_critical_number(trials, p, alpha), high = low;
  // Widens until the bracket holds: below(0) never does, below(trials + 1) always does.
  for (std::int64_t step = 1; low > 0 && below(low); step *= 2)
    high = low, low = std::max<std::int64_t>(0, low - step);
  for (std::int64_t step = 1; !below(high); step *= 2) low = high, high = std::min(trials + 1, high + step);
  return first_that(low, high, below);
}

}  // namespace plenolab
