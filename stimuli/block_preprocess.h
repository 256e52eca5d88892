#pragma once

#include <span>

#include "core/image/image.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// Samples a side of the block that becomes one delivered pixel (thesis of Altmeier, section 3.1.1).
inline constexpr int kBlockSide = 4;
inline constexpr int kBlockSamples = kBlockSide * kBlockSide;

/// Thresholds of the key-view preprocessing, in delivered pixels of disparity.
struct BlockOptions {
  double t1_px = 0.5;  ///< a block whose disparities differ by more holds a depth edge
  double t2_px =
      0.05;  ///< a sample this close to the foreground or background belongs to it; the others are dropped

  /// Throws InputError unless both are finite and ≥ 0.
  void validate() const;
};

/// One delivered pixel.
struct BlockPixel {
  Rgb radiance;
  float disparity_px = 0;
};

/// Reduces one block of 16 samples (any order). Without a depth edge, radiance and disparity are averages of
/// all samples. With one, the samples near the highest disparity (foreground) and near the lowest
/// (background) form two groups; the larger gives both averages, a tie goes to the foreground. A depth edge
/// is therefore aliased in both images, on purpose: no pixel mixes two depths.
BlockPixel preprocess_block(std::span<const Rgb, kBlockSamples> radiance,
                            std::span<const float, kBlockSamples> disparity_px, const BlockOptions& options);

/// Reduces whole images of 4× the delivered width and height; `disparity_px` is already in delivered pixels
/// per column spacing. Throws InputError if the sizes differ or are no multiple of 4.
KeyView<SceneReferred> preprocess_blocks(const SceneImage& radiance, const DisparityMap& disparity_px,
                                         const BlockOptions& options = {});

}  // namespace plenolab
