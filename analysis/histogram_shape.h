#pragma once

#include <optional>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// How spiky the histogram of an image's luminance is. Rendered content is said to have luminances
/// "concentrated in smaller areas of the histogram and not spread all over the HDR range" (Zhao 2019, section
/// 2.2): concentration measures that, jaggedness whether neighbouring bins differ.
struct HistogramShape {
  static constexpr int kBins = 256;
  double log10_low = 0, log10_high = 0;  ///< of the bins: 0.5th and 99.5th percentile of luminance
  std::vector<double> shares;            ///< kBins, of the pixels between these, sum 1
  /// Share of the pixels in the fullest tenth (26) of the bins: 0.10 if all bins hold the same, 1 for one
  /// luminance.
  double concentration = 0;
  /// Share of the pixels that would have to change bin for the histogram to be its own smoothed version
  /// (Gaussian of 4 bins, mirrored at the ends): 0 for even histograms, towards 1 for single spikes.
  double jaggedness = 0;
};

/// Of the pixels above 0, whose unit does not matter; nothing if there are none. Noise of few pixels counts
/// as jaggedness: compare images of the same number of pixels.
std::optional<HistogramShape> histogram_shape(const Plane<float>& luminance);

}  // namespace plenolab
