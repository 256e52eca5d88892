#pragma once

#include <optional>
#include <span>

#include "core/image/image.h"

namespace plenolab {

/// Which pixels a logarithmic average of luminance takes, and how (Doronin & Barsi, section 4.1).
struct LogAverageOptions {
  enum class Rule {
    kAboveEpsilon,  ///< exp(Σ ln L / N) over the N pixels with L > ε: black surroundings do not count
                    ///< (equation 2)
    kOffset,        ///< exp(mean ln(δ + L)) over all pixels (equation 1)
  };
  Rule rule = Rule::kAboveEpsilon;
  double epsilon = 1e-4;  ///< cd/m²; [1e-30, 1e30]
  double delta = 1e-4;    ///< cd/m²; [1e-30, 1e30]

  void validate() const;
};

/// Σ ln L of `count` pixels. Adding sums up in a fixed order is what keeps results the same for any number of
/// threads.
struct LogSum {
  double ln_sum = 0;
  double count = 0;  ///< weighted in spread accumulation
  LogSum& operator+=(const LogSum& other) {
    ln_sum += other.ln_sum;
    count += other.count;
    return *this;
  }
  LogSum scaled(double weight) const { return {weight * ln_sum, weight * count}; }
  /// ln L̄; nothing if no pixel counted: then the average is undefined, not 0.
  std::optional<double> ln_average() const {
    return count > 0 ? std::optional(ln_sum / count) : std::nullopt;
  }
};

/// Sum over luminances ≥ 0, finite. No logarithm is taken of single values: their exponents are added and
/// their mantissas multiplied. Vectorised, the same bits on every processor; the error of the average is
/// below 1e-6.
LogSum log_sum(std::span<const float> luminance, const LogAverageOptions& options);

/// The same over Σ_i weights[i]·columns[i][v], v < length.
LogSum log_sum_of_mixture(std::span<const float* const> columns, std::span<const float> weights,
                          std::size_t length, const LogAverageOptions& options);

/// ln L̄ of an image, whose pixels are repaired as in core/image/repair.h; nothing if it is undefined.
std::optional<double> log_average(const SceneImage& image, const LogAverageOptions& options = {});

}  // namespace plenolab
