#pragma once

#include "metrics/comparison.h"

namespace plenolab {

/// Colour of a number in [0, 1] on the map "inferno" (black – purple – orange – light yellow), perceptually
/// uniform, safe for colour-blind readers and in grey print: polynomial of degree 6 fitted to the table of
/// van der Walt & Smith 2015 (to 0.013 in red and green, 0.035 in blue). Encoded (display) values. Values
/// outside [0, 1] count as the nearer end.
Rgb inferno(float value);

/// How error maps are drawn.
struct ErrorMapOptions {
  float full_scale = 0.25f;         ///< encoded difference drawn in the brightest colour, in (0, 1]
  Rgb invalid{0.35f, 0.35f, 0.4f};  ///< colour of pixels outside the mask

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// False-colour picture of the largest absolute encoded difference of the three channels at each pixel;
/// larger ones than full_scale saturate (share_above_threshold of metrics/difference.h counts them with that
/// threshold).
DisplayImage error_map(const SceneImage& test, const SceneImage& reference,
                       const ComparisonConditions& conditions, const ErrorMapOptions& options = {});
DisplayImage error_map(const DisplayImage& test, const DisplayImage& reference,
                       const ComparisonConditions& conditions, const ErrorMapOptions& options = {});

}  // namespace plenolab
