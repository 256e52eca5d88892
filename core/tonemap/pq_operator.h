#pragma once

#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Perceptual quantiser as a tone mapping operator (SMPTE ST 2084; Zhao 2019, section 2.3): luminance becomes
/// the PQ signal of an absolute luminance, with equal steps for equal just noticeable differences, over the
/// signal of the peak. Nothing is fitted: every image is mapped alike.
///
/// Input: scene-referred, cd/m² after scaling by cd_m2_per_unit. With V(Y) = ((c₁ + c₂Y^m₁)/(1 + c₃Y^m₁))^m₂
/// and Y = L/10⁴:   luma = V(L)/V(peak), cut to 1; then the colour ratio.
struct PqOptions {
  double peak_cd_m2 = 10000;     ///< becomes luma 1; (0, 1e6]
  double cd_m2_per_unit = 1;     ///< [1e-12, 1e12]
  double colour_exponent = 0.7;  ///< [0, 1]
  void validate() const;
};

/// V of a luminance in cd/m², not cut above 10⁴ cd/m² (V(1e9) = 1.776), which pq_encode (colour.h) is. ≥ 0.
double pq_signal(double luminance_cd_m2);
/// Its inverse, for signals below 1.99 (where it has its pole).
double pq_luminance(double signal);

ToneMapped apply(const PqOptions& options, const SceneImage& view, int threads = 0);

}  // namespace plenolab
