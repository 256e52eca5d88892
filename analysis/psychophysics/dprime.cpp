#include "analysis/psychophysics/dprime.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double phi(double z) {
  return cdf(boost::math::normal(), z);
}

double z_of(double p) {
  if (p <= 0) return -kInfinity;
  if (p >= 1) return kInfinity;
  return quantile(boost::math::normal(), p);
}

/// Of the two parts of a matching decision, how far each is separated.
double matching_share(double a, double b) {
  return phi(a) * phi(b) + phi(-a) * phi(-b);
}

double rate_of(Proportion count, bool log_linear) {
  count.validate();
  return log_linear ? log_linear_rate(count) : count.rate();
}

/// Variance of z(rate), by the delta method.
double variance_of_z(double rate, Proportion count) {
  const double density = pdf(boost::math::normal(), z_of(rate));
  return rate * (1 - rate) / (static_cast<double>(count.trials) * density * density);
}

}  // namespace

double proportion_correct(double dprime, DprimeModel model) {
  switch (model) {
    case DprimeModel::kTwoAlternatives:
      return phi(dprime / std::sqrt(2.0));
    case DprimeModel::kAbxIndependent:
      return matching_share(dprime / std::sqrt(2.0), dprime / 2);
    case DprimeModel::kAbxDifferencing:
      return matching_share(dprime / std::sqrt(2.0), dprime / std::sqrt(6.0));
  }
  return 0.5;
}

double dprime_of(double share, DprimeModel model) {
  if (!(share >= 0 && share <= 1))
    throw InputError(fmt::format("a share of correct answers is {} but must lie in [0, 1]", share));
  if (model == DprimeModel::kTwoAlternatives) return std::sqrt(2.0) * z_of(share);
  if (share <= 0.5) return 0;
  constexpr double kMost = 40;  // the share is 1 in double long before
  if (share >= proportion_correct(kMost, model)) return kInfinity;
  std::uintmax_t steps = 200;
  const auto bracket =
      boost::math::tools::toms748_solve([&](double d) { return proportion_correct(d, model) - share; }, 0.0,
                                        kMost, boost::math::tools::eps_tolerance<double>(50), steps);
  return 0.5 * (bracket.first + bracket.second);
}

double log_linear_rate(Proportion count) {
  count.validate();
  return (static_cast<double>(count.hits) + 0.5) / (static_cast<double>(count.trials) + 1);
}

Interval dprime_interval(Proportion correct, DprimeModel model, bool log_linear, double confidence) {
  const Interval share = clopper_pearson(correct, confidence);
  return {dprime_of(rate_of(correct, log_linear), model), dprime_of(share.low, model),
          dprime_of(share.high, model)};
}

YesNoSensitivity yes_no_sensitivity(Proportion hits, Proportion false_alarms, bool log_linear,
                                    double confidence) {
  if (!(confidence > 0 && confidence < 1))
    throw InputError(fmt::format("confidence is {} but must lie in (0, 1)", confidence));
  const double h = rate_of(hits, log_linear), f = rate_of(false_alarms, log_linear);
  if (std::min(h, f) <= 0 || std::max(h, f) >= 1)
    throw InputError("rates of 0 or 1 give no finite d′: use the log-linear rule");
  const double zh = z_of(h), zf = z_of(f), d = zh - zf;
  const double error = std::sqrt(variance_of_z(h, hits) + variance_of_z(f, false_alarms));
  const double half = error * z_of(0.5 + confidence / 2);
  return {{d, d - half, d + half}, -0.5 * (zh + zf), phi(d / 2)};
}

}  // namespace plenolab
