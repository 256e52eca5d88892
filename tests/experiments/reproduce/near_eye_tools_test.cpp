#include "experiments/reproduce/display/near_eye_tools.h"

#include <gtest/gtest.h>

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

TEST(NearEyeTools, AShareOverScenesStaysAShare) {
  const Interval interval = share_over_scenes({0.001, 0.002, 0.4, 0.001, 0.03}, 1);
  EXPECT_NEAR(interval.estimate, 0.0868, 1e-6);
  EXPECT_EQ(interval.low, 0);
  EXPECT_LT(interval.high, 1);
}

}  // namespace
}  // namespace plenolab
