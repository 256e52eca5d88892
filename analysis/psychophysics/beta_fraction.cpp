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
  // 1 − (a + b)x/(a + 1), written without the cancellation that large a and b would bring.
  double d = 1 / away_from_zero((1 + a * y - b * x) / (a + 1));
  double c = 1, fraction = d;
  const auto step = [&](double numerator) {
    d = 1 / away_from_zero(1 + numerator * d);
    c = away_from_zero(1 + numerator / c);
    fraction *= c * d;
    return std::abs(c * d - 1);
  };
  for (long long m = 1; m < kMostSteps; ++m) {
    const double k = static_cast<double>(m), two_k = 2 * k;
    step(k * (b - k) * x / ((a + two_k - 1) * (a + two_k)));
    if (step(-(a + k) * (a + b + k) * x / ((a + two_k) * (a + two_k + 1))) < 1e-15) return fraction;
  }
  PLENOLAB_CHECK(false, fmt::format("beta fraction of a = {}, b = {}, x = {} does not converge", a, b, x));
  return fraction;
}

}  // namespace plenolab::detail
