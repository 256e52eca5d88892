#include "analysis/psychophysics/welch.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/psychophysics/beta_fraction.h"
#include "core/base/error.h"
#include "core/base/quantile.h"

namespace plenolab {

namespace {

/// log I_x(a, b) where the continued fraction converges; y = 1 − x, and log_x more exact than log(x).
double log_incomplete_beta(double a, double b, double x, double y, double log_x, double log_y,
                           double log_beta) {
  return a * log_x + b * log_y - std::log(a) - log_beta + std::log(detail::beta_fraction(a, b, x, y));
}

/// log B(a, ½). The ratio of gamma functions loses digits for large a; its series (Abramowitz &
/// Stegun 6.1.47) has none to lose there.
double log_beta_with_half(double a) {
  const double log_ratio = a < 1e4 ? std::log(boost::math::tgamma_delta_ratio(a, 0.5))
                                   : -0.5 * std::log(a) - std::log1p((1 / (16 * a) - 1) / (8 * a));
  return 0.5 * std::log(std::numbers::pi) + log_ratio;
}

/// The means of all resamples, in the order of their indices.
std::vector<double> resampled_means(std::span<const double> values, const BootstrapOptions& options) {
  std::vector<double> means;
  bootstrap_interval(
      values,
      [&](std::span<const double> sample) {
        means.push_back(mean(sample));
        return means.back();
      },
      options);
  means.resize(static_cast<std::size_t>(options.resamples));  // the last call is for the values themselves
  return means;
}

double autocovariance(std::span<const double> values, double centre, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = lag; i < values.size(); ++i) sum += (values[i] - centre) * (values[i - lag] - centre);
  return sum;
}

}  // namespace

void SampleSummary::validate() const {
  if (n < 2)
    throw InputError(fmt::format("a mean of {} values has no standard deviation: give at least 2", n));
  if (!std::isfinite(mean)) throw InputError("a mean must be finite");
  if (!(sd >= 0 && std::isfinite(sd)))
    throw InputError(fmt::format("a standard deviation is {} but must be at least 0 and finite", sd));
}

SampleSummary summarise(std::span<const double> values) {
  if (values.size() < 2) throw InputError("a standard deviation needs at least two values");
  const double centre = mean(values);
  double squares = 0;
  for (const double v : values) squares += (v - centre) * (v - centre);
  return {centre, std::sqrt(squares / static_cast<double>(values.size() - 1)),
          static_cast<std::int64_t>(values.size())};
}

double log10_student_p(double t, double degrees_of_freedom) {
  if (!(degrees_of_freedom > 0) || !std::isfinite(t))
    throw InputError(
        fmt::format("Student's t of {} with {} degrees of freedom is not possible", t, degrees_of_freedom));
  if (t == 0) return 0;
  // p = I_x(ν/2, ½) with x = ν/(ν + t²); log(x) by log1p, since x is near 1 for many degrees of freedom.
  const double a = degrees_of_freedom / 2, b = 0.5, ratio = t / degrees_of_freedom * t;
  const double log_x = -std::log1p(ratio), log_y = -std::log1p(1 / ratio);
  const double x = std::exp(log_x), y = std::exp(log_y);
  const double log_beta = log_beta_with_half(a);
  if (x < (a + 1) / (a + b + 2))
    return log_incomplete_beta(a, b, x, y, log_x, log_y, log_beta) / std::numbers::ln10;
  const double other = std::exp(log_incomplete_beta(b, a, y, x, log_y, log_x, log_beta));
  return std::log1p(-std::min(other, 1.0)) / std::numbers::ln10;
}

WelchTest welch_test(const SampleSummary& first, const SampleSummary& second, double confidence) {
  first.validate();
  second.validate();
  if (!(confidence > 0 && confidence < 1))
    throw InputError(fmt::format("confidence is {} but must lie in (0, 1)", confidence));
  const auto variance_of_mean = [](const SampleSummary& s) { return s.sd * s.sd / static_cast<double>(s.n); };
  const auto share = [](double v, const SampleSummary& s) { return v * v / static_cast<double>(s.n - 1); };
  const double v1 = variance_of_mean(first), v2 = variance_of_mean(second);
  if (!(v1 + v2 > 0)) throw InputError("both standard deviations are 0: there is nothing to test against");
  WelchTest test;
  test.degrees_of_freedom = (v1 + v2) * (v1 + v2) / (share(v1, first) + share(v2, second));
  const double difference = first.mean - second.mean, error = std::sqrt(v1 + v2);
  test.t = difference / error;
  test.log10_p = log10_student_p(test.t, test.degrees_of_freedom);
  test.p_two_sided = std::pow(10, test.log10_p);
  const boost::math::students_t student(test.degrees_of_freedom);
  const double half = error * quantile(complement(student, (1 - confidence) / 2));
  test.difference = {difference, difference - half, difference + half};
  return test;
}

Interval block_bootstrap_difference(std::span<const double> first, std::span<const double> second,
                                    const BootstrapOptions& options) {
  BootstrapOptions other = options;
  other.seed = ~options.seed;  // the two samples are drawn independently
  std::vector<double> differences = resampled_means(first, options);
  const std::vector<double> subtracted = resampled_means(second, other);
  for (std::size_t i = 0; i < differences.size(); ++i) differences[i] -= subtracted[i];
  std::sort(differences.begin(), differences.end());
  const std::span<const double> sorted = differences;
  const double tail = (1 - options.confidence) / 2;
  return {mean(first) - mean(second), quantile_of_sorted(sorted, tail), quantile_of_sorted(sorted, 1 - tail)};
}

int block_length_for(std::span<const double> values) {
  const double centre = mean(values), variance = autocovariance(values, centre, 0);
  const std::size_t most = std::max<std::size_t>(1, values.size() / 10);
  const double limit = 2 / std::sqrt(static_cast<double>(values.size()));
  std::size_t lag = 1;
  while (variance > 0 && lag < most && std::abs(autocovariance(values, centre, lag)) > limit * variance)
    ++lag;
  return static_cast<int>(lag == 1 ? 1 : std::min(most, 2 * lag));
}

}  // namespace plenolab
