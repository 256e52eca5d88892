#pragma once

#include "core/display/subimages.h"
#include "core/image/image.h"

namespace plenolab {

/// Where depth edges and holes of a light field lie, on the pixels of the display's subimages, each of which
/// stands for `factor` × `factor` rendered ones. Nothing reaches from one subimage into its neighbour.

/// 1 where the disparity of a rendered pixel differs by more than `edge_px` (px per camera) from that of the
/// pixel on its left or above it. `rendered` is the layout of `disparity_px`, its size a multiple of
/// `factor`.
Mask depth_edges(const Plane<float>& disparity_px, const SubimageLayout& rendered, int factor, float edge_px);

/// 1 where a rendered pixel is a hole (negative in `taken_px`, see ReprojectionResult::disparity_px), and in
/// the ring of one pixel around, which down-sampling and interpolation mix with holes.
Mask holes_with_ring(const Plane<float>& taken_px, const SubimageLayout& rendered, int factor);

/// Steps up, down, left and right to the nearest marked pixel of the same subimage, 0 on one; kNoneMarked
/// where the subimage has none. The mask's sides are multiples of `size_px`.
inline constexpr int kNoneMarked = 1 << 20;
Plane<int> steps_to_marked(const Mask& marked, int size_px);

}  // namespace plenolab
