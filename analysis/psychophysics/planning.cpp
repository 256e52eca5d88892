#include "analysis/psychophysics/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/psychophysics/binomial.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr double kMostPlanned = 1e6;

void check_power(double power) {
  if (!(power > 0 && power < 1))
    throw InputError(fmt::format("the power wanted is {} but must lie in (0, 1)", power));
}

/// A number of trials from which the power is certain by Hoeffding's inequality: the critical number lies at
/// most √(n ln(1/α)/2) + 2 above n·p_null, and the count falls short of n·p_true by more than √(n ln(1/β)/2)
/// with probability β at most. `distance` = p_true − p_null.
std::int64_t certain_trials(double distance, double alpha, double beta) {
  const double a = std::sqrt(std::log(1 / alpha) / 2) + std::sqrt(std::log(1 / beta) / 2);
  const double root = (a + std::sqrt(a * a + 8 * distance)) / (2 * distance);
  const double trials = std::ceil(root * root);
  if (trials > kMostPlanned)
    throw InputError(fmt::format(
        "rates only {:.3g} apart may need {:.3g} trials, more than the {:g} that are tried: ask for less",
        distance, trials, kMostPlanned));
  return static_cast<std::int64_t>(trials);
}

/// Critical numbers for one more trial after another: each is the last one or one more.
class CriticalNumbers {
 public:
  CriticalNumbers(double p, double alpha) : p_(p), log_alpha_(std::log(alpha) - 1e-12) {}
  std::int64_t next() {
    ++trials_;
    while (!(log_upper_tail(critical_, trials_, p_) < log_alpha_)) ++critical_;
    return critical_;
  }

 private:
  double p_, log_alpha_;
  std::int64_t trials_ = 0, critical_ = 1;
};

/// `power_of` is called for 1, 2, … `most` in order.
SampleSize sizes_with(double power, std::int64_t most, const std::function<double(std::int64_t)>& power_of) {
  SampleSize size{0, 1};
  for (std::int64_t n = 1; n <= most; ++n) {
    const bool enough = power_of(n) >= power;
    if (enough && size.first == 0) size.first = n;
    if (!enough) size.stable = n + 1;
  }
  return size;
}

}  // namespace

double test_power(std::int64_t trials, double p_null, double p_true, double alpha) {
  return upper_tail(critical_number(trials, p_null, alpha), trials, p_true);
}

void TestPlan::validate() const {
  check_power(power);
  if (!(alpha > 0 && alpha < 1)) throw InputError(fmt::format("alpha is {} but must lie in (0, 1)", alpha));
  if (!(p_null >= 0 && p_true <= 1 && p_true > p_null))
    throw InputError(fmt::format("the true rate {} must lie above the tested rate {}, both within [0, 1]",
                                 p_true, p_null));
}

SampleSize plan_test(const TestPlan& plan) {
  plan.validate();
  const std::int64_t most = certain_trials(plan.p_true - plan.p_null, plan.alpha, 1 - plan.power);
  CriticalNumbers critical(plan.p_null, plan.alpha);
  return sizes_with(plan.power, most,
                    [&](std::int64_t n) { return upper_tail(critical.next(), n, plan.p_true); });
}

SampleSize plan_equivalence(const EquivalenceOptions& options, double p_true, double power) {
  options.validate();
  check_power(power);
  const double distance = std::min(p_true - options.low(), options.high() - p_true);
  if (!(distance > 0))
    throw InputError(fmt::format("the true rate {} must lie between {:g} and {:g}, within the margin", p_true,
                                 options.low(), options.high()));
  const std::int64_t most = certain_trials(distance, options.alpha, (1 - power) / 2);
  CriticalNumbers low(options.low(), options.alpha), high(1 - options.high(), options.alpha);
  return sizes_with(power, most, [&](std::int64_t n) {
    const EquivalenceRegion region{low.next(), n - high.next()};
    if (region.empty()) return 0.0;
    return 1 - lower_tail(region.low - 1, n, p_true) - upper_tail(region.high + 1, n, p_true);
  });
}

std::vector<double> power_curve(double p_null, double p_true, double alpha, std::int64_t most) {
  TestPlan{.p_null = p_null, .p_true = p_true, .alpha = alpha}.validate();
  std::vector<double> powers;
  CriticalNumbers critical(p_null, alpha);
  for (std::int64_t n = 1; n <= most; ++n) powers.push_back(upper_tail(critical.next(), n, p_true));
  return powers;
}

}  // namespace plenolab
