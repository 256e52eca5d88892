#include "analysis/psychophysics/beta_fraction.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"

namespace plenolab::detail {

namespace {

constexpr double kTiny = 1e-300;
constexpr long long kMostSteps = 20'000'000;

double away_from_zero(double value) {
  return std::abs(value) < kTiny ? kTiny : value;
}

}  // namespace

double beta_fraction(double a, double b, double x, double y) {
  // (a + 1) − (a + b + …)x, written without the cancellation that large a and b would bring.
  const double lambda = a * y - b * x;
  const auto denominator = [&](double n) {
    const double first = n > 0 ? n + n * (b - n) * x / (a + 2 * n - 1) : 0;
    return first + (a + n) / (a + 2 * n + 1) * (lambda + 1 + n * (1 + y));
  };
  double fraction = away_from_zero(denominator(0)), c = fraction, d = 0;
  for (long long m = 1; m < kMostSteps; ++m) {
    const double n = static_cast<double>(m), middle = a + 2 * n - 1;
    const double numerator = (a + n - 1) / middle * ((a + b + n - 1) / middle) * n * (b - n) * x * x;
    d = 1 / away_from_zero(denominator(n) + numerator * d);
    c = away_from_zero(denominator(n) + numerator / c);
    fraction *= c * d;
    if (std::abs(c * d - 1) < 1e-15) return a / fraction;
  }
  PLENOLAB_CHECK(false, fmt::format("beta fraction of a = {}, b = {}, x = {} does not converge", a, b, x));
  return 0;
}

}  // namespace plenolab::detail
