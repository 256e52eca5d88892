#pragma once

#include <functional>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// Picture work of the figures: cutting out, magnifying, marking, and finding the place worth showing.

/// A rectangle of pixels.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// Marks as in the thesis: red squares for what is enlarged, green lines for the cut of an epipolar image.
inline constexpr Rgb kCropMark{1, 0, 0};
inline constexpr Rgb kCutMark{0, 1, 0};

/// The part of an image inside a box, which must lie within the image.
SceneImage crop(const SceneImage& image, const PixelBox& box);
DisplayImage crop(const DisplayImage& image, const PixelBox& box);

/// Every pixel repeated `factor` ≥ 1 times along both axes: nothing is interpolated.
DisplayImage magnify(const DisplayImage& image, int factor);

/// The image with a one-pixel frame around the box: outside of it, inside where the image ends.
DisplayImage mark_box(DisplayImage image, const PixelBox& box, Rgb colour = kCropMark);

/// The image with a line over row `row`.
DisplayImage mark_row(DisplayImage image, int row, Rgb colour = kCutMark);

/// The image with a line over column `column`.
DisplayImage mark_column(DisplayImage image, int column, Rgb colour = kCutMark);

/// Exposure of the whole views: the 95th percentile of the truth's luminance becomes 1. Interiors with bright
/// openings would be black at the 99th (exposure_from); the thesis adjusts brightness for print. 1 without a
/// positive pixel.
float figure_exposure(const SceneImage& truth);

/// Exposure of an enlarged part: brings the 99th percentile of the truth inside it to 1, but is not darker
/// than the whole view's.
float crop_exposure(const SceneImage& truth, const PixelBox& box);

/// Side of the square that a figure enlarges four times: a sixth of the width, at least 16 px, at most the
/// image.
int crop_size(int width, int height);

/// The square of `size` px with the largest sum of weights; of equal ones the first in reading order, and the
/// one in the middle of the image if all weights are 0. Weights ≥ 0.
PixelBox densest_box(const Plane<float>& weights, int size);

/// Row inside the box with the largest sum of weights, the middle one if all are 0.
int densest_row(const Plane<float>& weights, const PixelBox& box);

/// Mean over the (2·radius + 1)² pixels around each pixel, as far as they lie in the image.
Plane<float> box_mean(const Plane<float>& values, int radius);

/// Squared difference of encoded luminance, smoothed over (2·radius + 1)² px before it is squared, so that
/// noise counts little and misplaced content much.
Plane<float> smoothed_squared_difference(const SceneImage& test, const SceneImage& reference, float exposure,
                                         int radius = 2);

/// Number of pixels that are not 0.
std::size_t count_set(const Mask& mask);

/// 1 where the mask is set, 0 elsewhere.
Plane<float> as_weights(const Mask& mask);

/// Root mean square difference of encoded colours (all channels) over a box.
double rms_difference(const SceneImage& test, const SceneImage& reference, float exposure,
                      const PixelBox& box);

}  // namespace plenolab
