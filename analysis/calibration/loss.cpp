#include "analysis/calibration/loss.h"

#include <cmath>
#include <numbers>

namespace plenolab {

double influence(const CalibrationFitOptions& options, double r) {
  const double k = options.scale();
  switch (options.loss) {
    case CalibrationLoss::kHuber:
      return std::abs(r) <= k ? r : std::copysign(k, r);
    case CalibrationLoss::kCauchy:
      return r / (1 + r * r / (k * k));
    case CalibrationLoss::kNone:
      break;
  }
  return r;
}

double influence_slope(const CalibrationFitOptions& options, double r) {
  const double k = options.scale(), q = r * r / (k * k);
  switch (options.loss) {
    case CalibrationLoss::kHuber:
      return std::abs(r) <= k ? 1 : 0;
    case CalibrationLoss::kCauchy:
      return (1 - q) / ((1 + q) * (1 + q));
    case CalibrationLoss::kNone:
      break;
  }
  return 1;
}

double loss_weight(const CalibrationFitOptions& options, double r) {
  return r == 0 ? 1 : influence(options, r) / r;
}

namespace {

/// Means over standard normal errors, by the midpoint rule, which is exact to rounding for the smooth parts.
LossMoments moments_of_normal_errors(const CalibrationFitOptions& options) {
  if (options.loss == CalibrationLoss::kNone) return {};
  constexpr double kEnd = 9, kStep = 1.0 / 256;
  LossMoments moments{0, 0};
  for (double r = -kEnd + kStep / 2; r < kEnd; r += kStep) {
    const double density = std::exp(-r * r / 2) / std::sqrt(2 * std::numbers::pi) * kStep;
    moments.mean_slope += density * influence_slope(options, r);
    moments.mean_square += density * influence(options, r) * influence(options, r);
  }
  return moments;
}

}  // namespace

LossMoments loss_moments(const CalibrationFitOptions& options, std::span<const double> deviations) {
  const LossMoments normal = moments_of_normal_errors(options);
  if (deviations.empty() || options.loss == CalibrationLoss::kNone) return normal;
  LossMoments sum{0, 0};
  for (const double r : deviations) {
    const bool outlier = std::abs(r) > options.outlier_deviations;
    sum.mean_slope += outlier ? influence_slope(options, r) : normal.mean_slope;
    sum.mean_square += outlier ? influence(options, r) * influence(options, r) : normal.mean_square;
  }
  const auto count = static_cast<double>(deviations.size());
  return {sum.mean_slope / count, sum.mean_square / count};
}

}  // namespace plenolab
