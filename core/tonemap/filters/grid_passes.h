#pragma once

#include <vector>

#include "core/base/huge_pages.h"
#include "core/tonemap/filters/grid_layout.h"

namespace plenolab {

using GridData = std::vector<float, HugePageAllocator<float>>;

/// What the passes between image and grid share.
struct GridImage {
  const BilateralInput& input;
  const GridAxes& axes;
  const GridLayout& layout;
  float centre;  ///< taken off the values, so that sums keep their last digits
};

/// Samples of the Gaussians that blur the grid, from the middle outwards; the spatial one is used along
/// columns and rows.
struct GridKernels {
  std::vector<float> space, bins, layers;
  int bin_reach = 0;  ///< bins.size() − 1, a multiple of kBinGroup
  bool one_sided = false;
};

GridKernels make_kernels(const BilateralInput& input, const GridSampling& sampling);

/// Adds every pixel to the samples around it, by linear interpolation.
GridData splat(const GridImage& image);

/// Blurs along all axes.
GridData blur(const GridLayout& layout, const GridData& data, const GridKernels& kernels, int threads);

/// Reads the filtered image off the blurred grid, by linear interpolation.
Plane<float> slice(const GridImage& image, const GridData& data);

}  // namespace plenolab
