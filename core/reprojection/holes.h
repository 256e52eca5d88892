#pragma once

#include <span>
#include <vector>

#include "core/reprojection/reprojection.h"

namespace plenolab::reprojection {

/// A subimage while it is filled.
struct Subimage {
  Rgb* colour = nullptr;
  std::ptrdiff_t stride = 0;            ///< between rows of colours
  const float* disparity_px = nullptr;  ///< row by row without gaps; kNoDepth in holes
  int size_px = 0;
};

/// Gives the holes of a subimage a colour. `corners` are the corner cameras'
/// colours (rows `stride` apart).
void fill_holes(const Subimage& target, HoleFill fill, std::span<const Rgb* const> corners);

}  // namespace plenolab::reprojection
