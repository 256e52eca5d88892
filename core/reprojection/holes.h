#pragma once

#include <span>
#include <vector>

#include "core/reprojection/reprojection.h"

namespace plenolab::reprojection {

/// A subimage while it is filled; rows of both arrays are `stride` apart.
struct Subimage {
  Rgb* colour = nullptr;
  float* disparity_px = nullptr;  ///< kNoDepth in holes
  std::ptrdiff_t stride = 0;
  int size_px = 0;
};

/// Gives the holes of a subimage a colour; their disparity stays kNoDepth. `corners` are the corner cameras'
/// colours (rows `stride` apart).
void fill_holes(const Subimage& target, HoleFill fill, std::span<const Rgb* const> corners);

}  // namespace plenolab::reprojection
