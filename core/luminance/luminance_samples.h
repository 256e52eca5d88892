#pragma once

#include <vector>

#include "core/luminance/global_luminance.h"

namespace plenolab {

/// Steps that the fast and the literal estimate share (global_luminance.h).

/// Sums of the samples turned into ln L̄, undefined ones filled.
GlobalLuminance finish_samples(const ObserverSamples& samples, const std::vector<LogSum>& sums);

/// Equation 4: (a + ½ before + ½ after) of sums and counts, along x, on a plane then along y. Neighbours that
/// there are not add nothing.
std::vector<LogSum> smoothed_sums(const ObserverSamples& samples, const std::vector<LogSum>& sums);

/// Throws InputError unless the luminance is of the display's size; validates samples and options.
void require_estimable(const RayDisplay& display, const RayValues<float>& luminance,
                       const ObserverSamples& samples, const LuminanceOptions& options);

/// The sum of one sample by the letter: of its perceived image, or with the logarithm taken first (spread).
LogSum literal_brute_force(const RayDisplay& display, const RayValues<float>& luminance,
                           ObserverPosition observer, PinholeSize size, const LogAverageOptions& average);
LogSum literal_spread(const RayDisplay& display, const RayValues<float>& luminance, ObserverPosition observer,
                      bool normalised, const LogAverageOptions& average);
/// The sums of all samples, ray by ray.
std::vector<LogSum> literal_accumulation(const RayDisplay& display, const RayValues<float>& luminance,
                                         const ObserverSamples& samples, const LogAverageOptions& average);

}  // namespace plenolab
