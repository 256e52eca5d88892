#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// Which pairs of neighbouring pixels lie on either side of a depth edge, and how contrast is taken there.
struct DepthEdgeOptions {
  double least_disparity_px = 1;  ///< neighbours whose disparities differ by more belong to two surfaces
  double same_surface_px = 0.25;  ///< and by no more than this to one
  int side_px = 3;                ///< pixels averaged on each side against noise, all of one surface; ≥ 1
  /// Contrasts of the view above this take no part, log10 units.
  double most_contrast_log10 = std::numeric_limits<double>::infinity();
};

/// Contrast summed over the edges of a view.
struct DepthEdgeContrast {
  std::int64_t edges = 0;
  double input = 0;           ///< Σ |ΔI|, log10 units
  std::vector<double> along;  ///< of each plane Σ sign(ΔI)·Δplane
};

/// Contrast across depth edges of a view of log luminance I, and that of other planes of its size (e.g.
/// layers) counted positive where it has the sign of the view's. Pairs beside and above each other; those too
/// near to the image border or to another edge for `side_px` pixels of one surface take no part.
DepthEdgeContrast contrast_across_depth_edges(const Plane<float>& log_luminance,
                                              const DisparityMap& disparity,
                                              std::span<const Plane<float>* const> planes,
                                              const DepthEdgeOptions& options);

}  // namespace plenolab
