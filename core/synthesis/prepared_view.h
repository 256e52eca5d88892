#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/huge_pages.h"
#include "core/image/image.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// Blend-encoded colour and disparity of one pixel, fetched together.
struct alignas(16) ColourDisparity {
  float r = 0, g = 0, b = 0, disparity = 0;
};

/// Smallest and largest disparity of a group of pixels.
struct DisparityRange {
  float min = 0, max = 0;
};

/// Synthesis reads a few rows of many places at a time: far apart in memory, hence huge pages.
template <class T>
using LargePlane = Plane<T, HugePageAllocator<T>>;

/// A key view in the form that synthesis reads. It needs about 20 bytes a pixel; the key
/// view itself need not be kept.
/// - Scene-referred colour is max(C, 0)^(1/2.2), unclipped; display-referred colour is taken as it is.
/// - Radiance is repaired as in core/image/repair.h; non-finite code values and non-finite or negative
///   disparities count as 0. How many were replaced is in `repaired_values`.
struct PreparedView {
  static constexpr int kPadding = 20;     ///< columns of edge pixels repeated at either side of `disparity`
  static constexpr int kPaddingRows = 2;  ///< rows of edge pixels repeated above and below
  static constexpr int kBlock = 8;        ///< quads along the edge of a block of `blocks`

  int width = 0, height = 0;
  LargePlane<ColourDisparity> pixels;
  LargePlane<float> disparity;   ///< with its edge repeated: pixel (x, y) at (x + kPadding, y + kPaddingRows)
  Plane<DisparityRange> blocks;  ///< over the 9 × 9 pixels of each 8 × 8 block of quads
  float min_disparity = 0, max_disparity = 0;
  float largest_finite = 0;  ///< largest finite radiance, which +Inf counts as
  float max_quad_range = 0;  ///< largest max − min over all 2 × 2 pixels: no depth edge above it
  std::size_t repaired_values = 0;

  /// First value of row y of the disparity, indexable from −kPadding to width + kPadding − 1.
  const float* disparity_row(int y) const { return disparity.row(y + kPaddingRows) + kPadding; }
  std::size_t memory_bytes() const;
};

/// Prepares one key view, on `threads` threads.
PreparedView prepare_view(const KeyView<SceneReferred>& view, int threads = 0);
PreparedView prepare_view(const KeyView<DisplayReferred>& view, int threads = 0);

/// The colour a prepared view stands for, before encoding, repaired as in core/image/repair.h; `largest` is
/// the view's largest_finite.
Rgb repaired_colour(Rgb colour, float largest, SceneReferred);
/// The same for code values: non-finite ones count as 0.
Rgb repaired_colour(Rgb colour, float largest, DisplayReferred);

}  // namespace plenolab
