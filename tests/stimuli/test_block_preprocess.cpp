#include "stimuli/block_preprocess.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/error.h"

namespace plenolab {
namespace {

using Radiance = std::array<Rgb, kBlockSamples>;
using Disparity = std::array<float, kBlockSamples>;

// `count` samples of one disparity and grey level, appended at `begin`.
void fill(Radiance& radiance, Disparity& disparity, std::size_t begin, std::size_t count, float d,
          float grey) {
  for (std::size_t i = begin; i < begin + count; ++i)
    disparity[i] = d, radiance[i] = {grey, 2 * grey, 3 * grey};
}

TEST(BlockPreprocess, AConstantBlockStaysAsItIs) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 16, 7.3f, 0.1f);
  const BlockPixel pixel = preprocess_block(radiance, disparity, {});
  EXPECT_FLOAT_EQ(pixel.disparity_px, 7.3f);
  EXPECT_FLOAT_EQ(pixel.radiance.g, 0.2f);
}

TEST(BlockPreprocess, WithoutADepthEdgeEverySampleCounts) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 4, 1.0f, 8);
  fill(radiance, disparity, 4, 12, 1.5f, 0);  // a difference of exactly t1 is no edge
  const BlockPixel pixel = preprocess_block(radiance, disparity, {});
  EXPECT_FLOAT_EQ(pixel.disparity_px, 1.375f);
  EXPECT_FLOAT_EQ(pixel.radiance.r, 2);
}

TEST(BlockPreprocess, TheLargerGroupGivesThePixelWithoutMixing) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 9, 2, 1);
  fill(radiance, disparity, 9, 7, 10, 100);
  const BlockPixel background = preprocess_block(radiance, disparity, {});
  EXPECT_EQ(background.disparity_px, 2);
  EXPECT_EQ(background.radiance.r, 1);
  fill(radiance, disparity, 0, 7, 2, 1);
  fill(radiance, disparity, 7, 9, 10, 100);
  const BlockPixel foreground = preprocess_block(radiance, disparity, {});
  EXPECT_EQ(foreground.disparity_px, 10);
  EXPECT_EQ(foreground.radiance.r, 100);
}

TEST(BlockPreprocess, ATieGoesToTheForeground) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 8, 0, 1);
  fill(radiance, disparity, 8, 8, 3, 5);
  EXPECT_EQ(preprocess_block(radiance, disparity, {}).disparity_px, 3);
  EXPECT_EQ(preprocess_block(radiance, disparity, {}).radiance.r, 5);
}

TEST(BlockPreprocess, SamplesBetweenTheGroupsAreDropped) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 3, 10, 2);     // foreground
  fill(radiance, disparity, 3, 2, 1, 1);      // background
  fill(radiance, disparity, 5, 11, 5, 1000);  // mixed samples on the edge, most of the block
  const BlockPixel pixel = preprocess_block(radiance, disparity, {});
  EXPECT_EQ(pixel.disparity_px, 10);
  EXPECT_EQ(pixel.radiance.r, 2);
}

TEST(BlockPreprocess, AGroupReachesAsFarAsT2AndNoFarther) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 4, 1.0f, 1);
  fill(radiance, disparity, 4, 6, 1.25f, 5);
  fill(radiance, disparity, 10, 6, 4.0f, 50);
  EXPECT_EQ(preprocess_block(radiance, disparity, {0.5, 0.25}).radiance.r, 3.4f);  // (4·1 + 6·5) / 10
  EXPECT_EQ(preprocess_block(radiance, disparity, {0.5, 0.2}).radiance.r, 50);
}

TEST(BlockPreprocess, TheOrderOfSamplesDoesNotMatter) {
  Radiance radiance;
  Disparity disparity;
  fill(radiance, disparity, 0, 9, 2, 1);
  fill(radiance, disparity, 9, 7, 10, 100);
  const BlockPixel before = preprocess_block(radiance, disparity, {});
  std::reverse(radiance.begin(), radiance.end());
  std::reverse(disparity.begin(), disparity.end());
  EXPECT_EQ(preprocess_block(radiance, disparity, {}).radiance, before.radiance);
}

TEST(BlockPreprocess, AWholeImageIsReducedBlockByBlock) {
  SceneImage radiance(8, 4);
  DisparityMap disparity(8, 4, 1.0f);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) radiance.at(x, y) = x < 4 ? Rgb{1, 1, 1} : Rgb{static_cast<float>(y), 0, 0};
  disparity.at(7, 3) = 9;
  const auto view = preprocess_blocks(radiance, disparity);
  ASSERT_EQ(view.colour.width(), 2);
  ASSERT_EQ(view.colour.height(), 1);
  EXPECT_EQ(view.colour.at(0, 0), (Rgb{1, 1, 1}));
  EXPECT_FLOAT_EQ(view.colour.at(1, 0).r, 21.0f / 15);  // the background's 15 samples: all but one of the 3s
  EXPECT_EQ(view.disparity.at(1, 0), 1);
}

TEST(BlockPreprocess, WrongSizesAndThresholdsAreRefused) {
  EXPECT_THROW(preprocess_blocks(SceneImage(6, 4), DisparityMap(6, 4)), InputError);
  EXPECT_THROW(preprocess_blocks(SceneImage(8, 4), DisparityMap(4, 4)), InputError);
  EXPECT_THROW((BlockOptions{-1, 0.05}.validate()), InputError);
  EXPECT_THROW((BlockOptions{0.5, std::numeric_limits<double>::quiet_NaN()}.validate()), InputError);
}

}  // namespace
}  // namespace plenolab
