#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/psychophysics/proportion.h"

namespace plenolab {

/// Psychometric functions P(x) = γ + (1 − γ − λ) F(x): the share of answers that notice a difference over the
/// strength x of what differs (Wichmann & Hill 2001). γ: share when only guessing; λ: share of lapses.

enum class PsychometricShape {
  kNormal,    ///< F = Φ((x − location)/scale)
  kLogistic,  ///< F = 1/(1 + exp(−(x − location)/scale))
  kWeibull,   ///< F = 1 − exp(−(x/location)^(1/scale)), x > 0; usually written with slope β = 1/scale
};

/// Answers at one strength.
struct PsychometricLevel {
  double x = 0;
  Proportion noticed;
};

struct PsychometricOptions {
  PsychometricShape shape = PsychometricShape::kNormal;
  double guess_rate = 0.5;  ///< γ in [0, 1), held fixed unless free_guess
  double lapse_rate = 0;    ///< λ in [0, 1 − γ), held fixed unless free_lapse
  bool free_guess = false, free_lapse = false;
  double most_lapse = 0.1;  ///< bound of a free λ, in (0, 1 − γ)
  double most_guess = 0.6;  ///< bound of a free γ, in (0, 1)
  double confidence = 0.95;
  int resamples = 0;  ///< of the parametric bootstrap; 0 = no intervals, else ≥ 100
  std::uint64_t seed = 1;

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// What the data allow.
enum class PsychometricStatus {
  kFitted,
  kSeparable,  ///< at most one level lies on the slope: a step fits as well, the scale is not determined
  kFlat,       ///< the answers do not rise over the levels: neither location nor scale is determined
};

struct PsychometricFit {
  PsychometricOptions options;
  PsychometricStatus status = PsychometricStatus::kFitted;
  double location = 0, scale = 0, guess_rate = 0, lapse_rate = 0;
  double threshold = 0;                ///< x at which F = ½
  double negative_log_likelihood = 0;  ///< without binomial coefficients
  double deviance = 0;
  /// With resamples > 0 and status kFitted:
  std::optional<Interval> threshold_interval, scale_interval, lapse_interval;
  std::optional<double> deviance_p;  ///< share of resampled deviances at least as large
  int degenerate_resamples = 0;      ///< left out of the intervals; many mean that these are too short
};

/// Maximum likelihood, found by a quasi-Newton method from several starts; a free λ or γ may lie on its
/// bound. Throws InputError for fewer than two different levels, or levels that the shape does not take.
PsychometricFit fit_psychometric(std::span<const PsychometricLevel> levels,
                                 const PsychometricOptions& options = {});

/// P(x) of a fit.
double psychometric_value(const PsychometricFit& fit, double x);
/// x at which F has the value `share` in (0, 1).
double psychometric_level(const PsychometricFit& fit, double share);
/// The status in a sentence; empty for kFitted.
std::string status_text(PsychometricStatus status);

}  // namespace plenolab
