#pragma once

#include <optional>
#include <vector>

#include "core/tonemap/statistics.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Global photographic operator (Reinhard, Stark, Shirley & Ferwerda 2002, equations 1–4), with the automatic
/// key of Reinhard 2003.
///
/// Input: scene-referred, any unit (the result does not depend on it). Output: display values in [0, 1]:
///   L_s = key·L/L̄,   L_d = L_s·(1 + L_s/L_white²)/(1 + L_s), or L_s/(1 + L_s) without a white point,
///   out = L_d^(1/2.2)·(C/L)^colour_exponent.
/// With the default colour exponent 1/2.2 this equals encoding C·L_d/L by gamma.
struct ReinhardGlobalOptions {
  bool automatic_key = true;         ///< else `key`
  double key = 0.18;                 ///< (0, 4]
  bool white_point = false;          ///< whether L_white below takes part
  double white = 4;                  ///< in units of L_s, the smallest value that becomes 1; (0, 1e9]
  double colour_exponent = 1 / 2.2;  ///< [0, 1]
  void validate() const;
};

struct ReinhardGlobalParameters {
  double key = 0.18;
  double log_average = 0;       ///< log10 L̄
  std::optional<double> white;  ///< L_white
  double colour_exponent = 1 / 2.2;
};

/// 0.18·4^((2·log2 L̄ − log2 L_min − log2 L_max)/(log2 L_max − log2 L_min)) with L_min and L_max the
/// percentiles p1 and p99; 0.18 where these are equal. L̄ is cut to [p1, p99]: the key stays within 0.045 …
/// 0.72.
double automatic_key(const ImageStatistics& statistics);

/// L_d of L_s ≥ 0; without white point in [0, 1), with it 1 at L_s = white and above 1 beyond. Also used per
/// ray, where L̄ differs between pixels.
double reinhard_curve(double scaled_luminance, std::optional<double> white = std::nullopt);

ReinhardGlobalParameters fit(const ReinhardGlobalOptions& options, const ImageStatistics& statistics);
ToneMapped apply(const ReinhardGlobalParameters& parameters, const SceneImage& view, int threads = 0);

}  // namespace plenolab
