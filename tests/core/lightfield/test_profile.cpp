#include "core/lightfield/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/lightfield/synthetic.h"

namespace plenolab {
namespace {

constexpr ViewGrid kGrid{.columns = 2, .rows = 1, .width = 10, .height = 10};

LightField two_views(SceneImage a, SceneImage b, DisparityMap d) {
  std::vector<KeyView<SceneReferred>> views;
  views.push_back({std::move(a), d});
  views.push_back({std::move(b), d});
  return LightField::from_views(kGrid, RadianceUnit::kCdM2, "x", std::move(views));
}

TEST(Profile, AConstantLightFieldIsKnownAsSuch) {
  const SceneImage grey(10, 10, {3, 3, 3});
  const LightFieldProfile p = profile(two_views(grey, grey, DisparityMap(10, 10, 2)));
  EXPECT_EQ(p.views, 2);
  EXPECT_TRUE(p.constant_disparity);
  EXPECT_TRUE(p.constant_colour);
  EXPECT_TRUE(p.grey);
  EXPECT_EQ(p.depth_edge_share, 0);
  EXPECT_EQ(p.dynamic_range_log10, 0);
  EXPECT_EQ(p.lighting_change, 1);
  EXPECT_EQ(p.defects.total(), 0);
  EXPECT_EQ(p.min_disparity_px, 2);
}

TEST(Profile, AStepOfMoreThanOnePixelIsADepthEdgeInTheGroupsItCrosses) {
  DisparityMap d(10, 10, 1);
  for (int y = 0; y < 10; ++y)
    for (int x = 5; x < 10; ++x) d.at(x, y) = 2.5f;
  const SceneImage image(10, 10, {1, 0.5f, 1});
  EXPECT_DOUBLE_EQ(profile(two_views(image, image, d)).depth_edge_share, 1.0 / 9);
  for (float& v : d.pixels()) v = std::min(v, 2.0f);
  const LightFieldProfile p = profile(two_views(image, image, d));
  EXPECT_EQ(p.depth_edge_share, 0);
  EXPECT_FALSE(p.constant_disparity);
  EXPECT_FALSE(p.grey);
  EXPECT_EQ(p.max_disparity_px, 2);
}

TEST(Profile, TheDynamicRangeSpansThePercentilesWhateverTheLevel) {
  SceneImage image(10, 10);
  for (int i = 0; i < 100; ++i)
    image.pixels()[static_cast<std::size_t>(i)] = Rgb{1, 1, 1} * (i % 2 == 0 ? 1e-9f : 1e9f);
  const LightFieldProfile p = profile(two_views(image, image, DisparityMap(10, 10)));
  EXPECT_NEAR(p.log10_p1, -9, 0.01);
  EXPECT_NEAR(p.log10_p99, 9, 0.01);
  EXPECT_NEAR(p.dynamic_range_log10, 18, 0.01);
}

TEST(Profile, LightingChangeIsTheRatioOfLogAveragesOfNeighbours) {
  const LightFieldProfile p = profile(
      two_views(SceneImage(10, 10, {2, 2, 2}), SceneImage(10, 10, {10, 10, 10}), DisparityMap(10, 10)));
  EXPECT_NEAR(p.lighting_change, 5, 1e-5);
  EXPECT_FALSE(p.constant_colour);
}

TEST(Profile, DefectsAreCountedAndNeverReachTheNumbers) {
  SceneImage image(10, 10, {1, 1, 1});
  image.at(0, 0) = {std::nanf(""), std::nanf(""), 1};
  image.at(1, 0) = {INFINITY, 1, 1};
  image.at(2, 0) = {-1, -INFINITY, 1};
  const LightFieldProfile p = profile(two_views(image, SceneImage(10, 10), DisparityMap(10, 10)));
  EXPECT_EQ(p.defects, (PixelRepairs{2, 1, 2}));
  EXPECT_TRUE(std::isfinite(p.lighting_change) && std::isfinite(p.log10_p1) && std::isfinite(p.log10_p99));
}

TEST(Profile, BlackAndOnePixelViewsGiveFiniteNumbers) {
  const ViewGrid grid{.columns = 1, .rows = 1, .width = 1, .height = 1};
  const LightFieldProfile p = profile(
      LightField::from_views(grid, RadianceUnit::kRelative, "x", {{SceneImage(1, 1), DisparityMap(1, 1)}}));
  EXPECT_EQ(p.dynamic_range_log10, 0);
  EXPECT_EQ(p.depth_edge_share, 0);
  EXPECT_EQ(p.lighting_change, 1);
}

}  // namespace
}  // namespace plenolab
