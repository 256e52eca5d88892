#include "metrics/viewing_conditions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plenolab {
namespace {

TEST(SceneLuminance, CountsNegativeChannelsAsZeroAsOperatorsDo) {
  const SceneImage image(1, 1, Rgb{1, -0.5f, 0.25f});
  EXPECT_NEAR(scene_luminance(image, 100).at(0, 0), 100 * (0.2126 + 0.25 * 0.0722), 1e-4);
}

TEST(SceneLuminance, EndsAtTenToTheTenth) {
  EXPECT_EQ(scene_luminance(SceneImage(1, 1, Rgb{1e30f, 1e30f, 1e30f}), 1e9).at(0, 0), 1e10f);
}

TEST(RelativeLuminance, IsOneAtMostWhateverTheUnit) {
  for (const float scale : {1e-30f, 1.0f, 1e30f}) {
    SceneImage image(2, 1, Rgb{scale, scale, scale});
    image.at(1, 0) = 0.25f * image.at(0, 0);
    const Plane<float> luminance = relative_luminance(image);
    EXPECT_NEAR(luminance.at(0, 0), 1, 1e-6) << scale;
    EXPECT_NEAR(luminance.at(1, 0), 0.25, 1e-6) << scale;
  }
}

TEST(RelativeLuminance, OfABlackImageIsBlackAndLooksPastInfinity) {
  EXPECT_EQ(relative_luminance(SceneImage(2, 2)).at(1, 1), 0);
  SceneImage image(2, 1, Rgb{3, 3, 3});
  image.at(1, 0).g = std::numeric_limits<float>::infinity();
  EXPECT_NEAR(relative_luminance(image).at(0, 0), 1, 1e-6);
}

}  // namespace
}  // namespace plenolab
