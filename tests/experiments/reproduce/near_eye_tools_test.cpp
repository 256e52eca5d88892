#include "experiments/reproduce/display/near_eye_tools.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plenolab {
namespace {

DisplayImage ramp(float offset) {
  DisplayImage image(16, 4);
  for (std::size_t i = 0; i < image.size(); ++i)
    image.pixels()[i] = {0.01f * static_cast<float>(i) + offset, 0.5f, 0.2f};
  return image;
}

TEST(NearEyeTools, DifferencesAreThoseOfTheTables) {
  const DisplayImage a = ramp(0), b = ramp(0.013f);
  EXPECT_DOUBLE_EQ(mean_absolute(a, b), mean_difference(difference_statistics(a, b)));
  double sum = 0;
  const Plane<float> difference = absolute_difference(a, b);
  for (const float d : difference.pixels()) sum += static_cast<double>(d);
  EXPECT_NEAR(sum / static_cast<double>(a.size()), mean_absolute(a, b), 1e-7);
}

TEST(NearEyeTools, WhatHasTheSameCodesDoesNotDiffer) {
  const DisplayImage a(3, 3, {100.1f / 255, 0, 0}), b(3, 3, {99.9f / 255, 0, 0});
  EXPECT_EQ(mean_absolute(a, b), 0);
  EXPECT_EQ(share_beyond_codes(a, b, 0), 0);
}

TEST(NearEyeTools, APixelDiffersIfOneOfItsChannelsDoes) {
  DisplayImage a(4, 1, {0.5f, 0.5f, 0.5f}), b = a;
  b.at(1, 0).g = a.at(1, 0).g + 6 / 255.0f;  // 2 codes as a mean of the channels
  EXPECT_EQ(share_beyond_codes(a, b, 5), 0.25);
  EXPECT_EQ(share_beyond_codes(a, b, 6), 0);
}

TEST(NearEyeTools, ARatioOverScenesIsTheGeometricMeanAndNeverNegative) {
  const Interval ratio = ratio_over_scenes({1, 2, 100}, {2, 1, 1}, 1);
  EXPECT_NEAR(ratio.estimate, std::cbrt(100), 1e-9);
  EXPECT_GT(ratio.low, 0);
  // Turned round it is the reciprocal, ends included.
  const Interval turned = ratio_over_scenes({2, 1, 1}, {1, 2, 100}, 1);
  EXPECT_NEAR(ratio.low * turned.high, 1, 1e-9);
  EXPECT_NEAR(ratio.high * turned.low, 1, 1e-9);
}

TEST(NearEyeTools, AScaleOfOneSceneDoesNotMatter) {
  const Interval a = ratio_over_scenes({1, 3, 2}, {2, 2, 2}, 1),
                 b = ratio_over_scenes({1, 3, 2000}, {2, 2, 2000}, 1);
  EXPECT_NEAR(a.estimate, b.estimate, 1e-12);
  EXPECT_NEAR(a.high, b.high, 1e-12);
}

TEST(NearEyeTools, ScenesThatSayNothingAreLeftOutAndOneSceneDecidesNothing) {
  EXPECT_NEAR(ratio_over_scenes({0, 3, 3}, {0, 1, 1}, 1).estimate, 3, 1e-12);
  const Interval one = ratio_over_scenes({0, 3}, {0, 1}, 1);
  EXPECT_EQ(decide(one, Comparison::kAbove, 1), Outcome::kUndecided);
}

TEST(NearEyeTools, AShareOverScenesStaysAShare) {
  const Interval interval = share_over_scenes({0.001, 0.002, 0.4, 0.001, 0.03}, 1);
  EXPECT_NEAR(interval.estimate, 0.0868, 1e-6);
  EXPECT_EQ(interval.low, 0);
  EXPECT_LT(interval.high, 1);
}

}  // namespace
}  // namespace plenolab
