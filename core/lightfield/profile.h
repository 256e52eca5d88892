#pragma once

#include <cstdint>

#include "core/base/progress.h"
#include "core/image/repair.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// What a light field contains, measured before anything is computed from it: shown by `plenolab info`, and
/// the ground on which stages that cannot change the result are left out.
struct LightFieldProfile {
  int views = 0;
  float min_disparity_px = 0, max_disparity_px = 0;
  bool constant_disparity = false;  ///< one value in all pixels of all views
  double depth_edge_share =
      0;  ///< share of 2×2 pixel groups with max − min disparity > 1 px (rule 2 of the synthesis)
  double log10_p1 = 0,
         log10_p99 = 0;            ///< percentiles of log10 luminance over positive finite pixels, to 0.01
  double dynamic_range_log10 = 0;  ///< their difference; 0 without a positive pixel
  bool grey = false;               ///< r = g = b everywhere
  bool constant_colour = false;    ///< one colour in all pixels of all views
  PixelRepairs defects;  ///< NaN, Inf and negative values of all views (0 for display-referred ones in range)
  /// Largest ratio ≥ 1 of the log-average luminance of neighbouring views: 1 = constant lighting.
  double lighting_change = 1;
};

/// Measures every view once. Deterministic; memory as for one view.
LightFieldProfile profile(const LightField& light_field, const Progress& progress = {});
LightFieldProfile profile(const DisplayLightField& light_field, const Progress& progress = {});

}  // namespace plenolab
