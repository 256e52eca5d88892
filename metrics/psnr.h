#pragma once

#include "metrics/comparison.h"

namespace plenolab {

/// Peak signal-to-noise ratio 10·log10(peak² / MSE) in dB. All are +∞ for images without a difference.

/// psnr_linear_db: of linear radiance over all three channels; the peak is the largest channel value of the
/// reference (of its valid pixels); also given as psnr_linear_peak in the unit of the image. Not symmetric. A
/// reference without a positive value has no peak: −∞ unless the images are equal.
std::vector<Measurement> psnr_linear(const SceneImage& test, const SceneImage& reference,
                                     const ComparisonConditions& conditions);

/// psnr_gamma_db: of values encoded as clamp(exposure·C, 0, 1)^(1/2.2) over all three channels, peak 1;
/// display images as they are. Also gamma_clipped_share: share of reference pixels with a channel outside [0,
/// 1] before the clamp.
std::vector<Measurement> psnr_gamma(const SceneImage& test, const SceneImage& reference,
                                    const ComparisonConditions& conditions);
std::vector<Measurement> psnr_gamma(const DisplayImage& test, const DisplayImage& reference,
                                    const ComparisonConditions& conditions);

/// psnr_pq_db: of luminance (scaled by cd_m2_per_unit) encoded with PQ, SMPTE ST 2084, peak 1: differences
/// weigh about as the eye sees them over 0 … 10 000 cd/m². Also pq_clipped_share: share of reference pixels
/// outside that range.
std::vector<Measurement> psnr_pq(const SceneImage& test, const SceneImage& reference,
                                 const ComparisonConditions& conditions);

/// The ratio itself: +∞ for mean_squared_error = 0, −∞ for peak = 0 otherwise.
double psnr_db(double peak, double mean_squared_error);

}  // namespace plenolab
