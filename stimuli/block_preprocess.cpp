#include "stimuli/block_preprocess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

// Averages the samples `selected` says belong together. Sums in double: the order of samples must not show.
template <class Selected>
BlockPixel average(std::span<const Rgb, kBlockSamples> radiance,
                   std::span<const float, kBlockSamples> disparity, Selected selected) {
  double r = 0, g = 0, b = 0, d = 0;
  int count = 0;
  for (std::size_t i = 0; i < kBlockSamples; ++i) {
    if (!selected(disparity[i])) continue;
    r += radiance[i].r, g += radiance[i].g, b += radiance[i].b, d += disparity[i];
    ++count;
  }
  const double share = 1.0 / count;
  return {{static_cast<float>(r * share), static_cast<float>(g * share), static_cast<float>(b * share)},
          static_cast<float>(d * share)};
}

}  // namespace

void BlockOptions::validate() const {
  for (const double t : {t1_px, t2_px})
    if (!(t >= 0 && std::isfinite(t)))
      throw InputError(
          fmt::format("the thresholds of the block preprocessing must be 0 or more pixels, not {}", t));
}

BlockPixel preprocess_block(std::span<const Rgb, kBlockSamples> radiance,
                            std::span<const float, kBlockSamples> disparity, const BlockOptions& options) {
  const auto [low, high] = std::minmax_element(disparity.begin(), disparity.end());
  const double background = *low, foreground = *high;
  if (!(foreground - background > options.t1_px))
    return average(radiance, disparity, [](float) { return true; });
  const auto near_foreground = [&](float d) { return foreground - d <= options.t2_px; };
  const auto near_background = [&](float d) { return d - background <= options.t2_px; };
  const auto front = std::count_if(disparity.begin(), disparity.end(), near_foreground);
  const auto back = std::count_if(disparity.begin(), disparity.end(), near_background);
  return front >= back ? average(radiance, disparity, near_foreground)
                       : average(radiance, disparity, near_background);
}

KeyView<SceneReferred> preprocess_blocks(const SceneImage& radiance, const DisparityMap& disparity,
                                         const BlockOptions& options) {
  options.validate();
  if (radiance.width() != disparity.width() || radiance.height() != disparity.height())
    throw InputError(fmt::format("the disparity map is {} × {} pixels, the image {} × {}; they must be equal",
                                 disparity.width(), disparity.height(), radiance.width(), radiance.height()));
  if (radiance.width() % kBlockSide != 0 || radiance.height() % kBlockSide != 0)
    throw InputError(fmt::format("an image of 4 × 4 blocks cannot be {} × {} pixels", radiance.width(),
                                 radiance.height()));
  const int width = radiance.width() / kBlockSide, height = radiance.height() / kBlockSide;
  KeyView<SceneReferred> view{SceneImage(width, height), DisparityMap(width, height)};
  std::array<Rgb, kBlockSamples> block_radiance;
  std::array<float, kBlockSamples> block_disparity;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (int i = 0; i < kBlockSamples; ++i) {
        const int sx = x * kBlockSide + i % kBlockSide, sy = y * kBlockSide + i / kBlockSide;
        block_radiance[static_cast<std::size_t>(i)] = radiance.at(sx, sy);
        block_disparity[static_cast<std::size_t>(i)] = disparity.at(sx, sy);
      }
      const BlockPixel pixel = preprocess_block(block_radiance, block_disparity, options);
      view.colour.at(x, y) = pixel.radiance;
      view.disparity.at(x, y) = pixel.disparity_px;
    }
  return view;
}

}  // namespace plenolab
