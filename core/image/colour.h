#pragma once

#include "core/image/image.h"

namespace plenolab {

/// Luminance weights of linear BT.709 RGB (ITU-R BT.709-6, rounded as the papers use them).
inline constexpr Rgb kLuminanceWeights{0.2126f, 0.7152f, 0.0722f};

/// Luminance of linear RGB, in the unit of the RGB values.
constexpr float luminance(Rgb c) {
  return kLuminanceWeights.r * c.r + kLuminanceWeights.g * c.g + kLuminanceWeights.b * c.b;
}

/// The papers' gamma: max(v, 0)^(1/2.2), unclipped above 1.
float gamma_encode(float linear);
/// Inverse of gamma_encode for v ≥ 0: v^2.2.
float gamma_decode(float encoded);
Rgb gamma_encode(Rgb linear);
Rgb gamma_decode(Rgb encoded);

/// PQ signal in [0, 1] of a luminance in cd/m² (SMPTE ST 2084 inverse EOTF). Values below 0 count as 0, above
/// 10 000 as 10 000 cd/m², the ends of the standard's range.
double pq_encode(double luminance_cd_m2);
/// Luminance in cd/m² of a PQ signal in [0, 1] (SMPTE ST 2084 EOTF).
double pq_decode(double signal);

/// Display-ready picture of a scene: clamp(exposure · C, 0, 1)^(1/2.2). For looking and for metrics at one
/// exposure, not a tone mapping operator.
DisplayImage expose(const SceneImage& scene, float exposure);

/// Exposure that brings the 99th percentile of luminance to 1 (non-finite and negative pixels left out); 1
/// for an image without a positive pixel. Take it from the ground truth and use it on both images of a
/// comparison.
float exposure_from(const SceneImage& truth);

}  // namespace plenolab
