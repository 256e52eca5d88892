#pragma once

#include <cmath>
#include <optional>

namespace plenolab {

/// What radiance 1 of a light field or image is in cd/m², for operators whose result depends on it.
struct RadianceScale {
  std::optional<double> cd_m2_per_unit = 1;  ///< > 0; absent: radiance is relative
  /// log10 average luminance of the whole light field in its own unit, without weight of outliers
  /// (ImageStatistics::log_robust_average): the same for all of its views. Read if radiance is relative.
  double log_average = 0;

  /// Factor on radiance: to cd/m² if that is known, else so that the log average becomes `log_average_cd_m2`.
  double to_cd_m2(double log_average_cd_m2) const {
    // Within what operators take as a factor.
    const double log_factor = std::log10(log_average_cd_m2) - log_average;
    return cd_m2_per_unit.value_or(std::pow(10.0, std::fmin(std::fmax(log_factor, -12.0), 12.0)));
  }
};

}  // namespace plenolab
