#pragma once

#include "metrics/comparison.h"

namespace plenolab {

/// Structural similarity, Wang, Bovik, Sheikh & Simoncelli 2004 (Image quality assessment: from error
/// visibility to structural similarity), equation 13 with α = β = γ = 1: Gaussian window of 11×11 taps and σ
/// = 1.5, K1 = 0.01, K2 = 0.03, L = 1, only windows that lie inside the image, no downsampling, as in the
/// authors' ssim_index.m. Luma is the BT.709-weighted sum of encoded channels: clamp(exposure·C, 0,
/// 1)^(1/2.2), or display values as they are.
///
/// Images narrower or lower than the window (where the authors' code gives up) are compared with the window
/// cropped to min(11, width) × min(11, height) taps, centred and normalised to 1; for 1×1 only the luminance
/// term is left.

/// The similarity of every window; pixel (x, y) belongs to the window whose top-left tap is on pixel (x, y)
/// of the images. Size (width − min(11, width) + 1) × (height − min(11, height) + 1). Values in [−1, 1]. The
/// mask is not used.
Plane<float> ssim_map(const SceneImage& test, const SceneImage& reference,
                      const ComparisonConditions& conditions);
Plane<float> ssim_map(const DisplayImage& test, const DisplayImage& reference,
                      const ComparisonConditions& conditions);

/// ssim_gamma: mean of the map. With a mask, only windows all of whose pixels are valid count; InputError if
/// there is none.
std::vector<Measurement> ssim_gamma(const SceneImage& test, const SceneImage& reference,
                                    const ComparisonConditions& conditions);
std::vector<Measurement> ssim_gamma(const DisplayImage& test, const DisplayImage& reference,
                                    const ComparisonConditions& conditions);

}  // namespace plenolab
