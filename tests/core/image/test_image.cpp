#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "core/image/colour.h"
#include "core/image/image.h"
#include "core/image/repair.h"

namespace plenolab {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Image, PixelsAreStoredRowByRowFromTheTop) {
  Plane<int> plane(3, 2, 7);
  plane.at(2, 1) = 9;
  EXPECT_EQ(plane.pixels()[5], 9);
  EXPECT_EQ(plane.row(1)[2], 9);
  EXPECT_EQ(plane.at(0, 0), 7);
  EXPECT_EQ(plane.size(), 6u);
  EXPECT_TRUE(Plane<int>().empty());
}

TEST(Image, SceneAndDisplayImagesDoNotConvertIntoEachOther) {
  static_assert(!std::is_convertible_v<SceneImage, DisplayImage> &&
                !std::is_convertible_v<DisplayImage, SceneImage>);
  static_assert(!std::is_constructible_v<SceneImage, DisplayImage> &&
                !std::is_assignable_v<SceneImage&, DisplayImage>);
  EXPECT_EQ(SceneImage(2, 2), SceneImage(2, 2));
}

TEST(Colour, LuminanceOfWhiteIsOneAndWeightsAreThoseOfTheStandard) {
  EXPECT_NEAR(luminance({1, 1, 1}), 1, 1e-7);
  EXPECT_FLOAT_EQ(luminance({0, 1, 0}), 0.7152f);
}

// Independent evaluation of SMPTE ST 2084's equations; 100 cd/m² = 0.508078 is the value quoted everywhere.
TEST(Colour, PqSignalsAreThoseOfTheStandard) {
  EXPECT_NEAR(pq_encode(100), 0.508078421517399, 1e-12);
  EXPECT_NEAR(pq_encode(1), 0.14994573210018022, 1e-12);
  EXPECT_NEAR(pq_encode(0.005), 0.015076399042367938, 1e-12);
  EXPECT_NEAR(pq_encode(1000), 0.751827096247041, 1e-12);
  EXPECT_NEAR(pq_encode(0), 7.309559025783966e-07, 1e-15);
  EXPECT_EQ(pq_encode(10000), 1);
  EXPECT_EQ(pq_encode(1e9), 1);
  EXPECT_EQ(pq_encode(-5), pq_encode(0));
}

TEST(Colour, PqDecodesWhatItEncodes) {
  for (const double y : {1e-4, 0.01, 0.5, 48.0, 203.0, 4000.0, 10000.0})
    EXPECT_NEAR(pq_decode(pq_encode(y)) / y, 1, 1e-9);
  EXPECT_EQ(pq_decode(0), 0);
  EXPECT_NEAR(pq_decode(2), 10000, 1e-6);
  double before = -1;
  for (int i = 0; i <= 1023; ++i) {
    const double y = pq_decode(i / 1023.0);
    EXPECT_GE(y, before);
    before = y;
  }
}

TEST(Colour, GammaIsThePapersAndUnclipped) {
  EXPECT_FLOAT_EQ(gamma_encode(0.5f), static_cast<float>(std::pow(0.5, 1 / 2.2)));
  EXPECT_FLOAT_EQ(gamma_encode(4.0f), static_cast<float>(std::pow(4.0, 1 / 2.2)));
  EXPECT_EQ(gamma_encode(-1.0f), 0);
  EXPECT_EQ(gamma_decode(-1.0f), 0);
  for (const float v : {1e-9f, 0.2f, 1.0f, 1e9f}) EXPECT_NEAR(gamma_decode(gamma_encode(v)) / v, 1, 1e-5);
}

TEST(Colour, ExposureBringsThe99thPercentileToOne) {
  SceneImage image(100, 1);
  for (int x = 0; x < 100; ++x) image.at(x, 0) = Rgb{1, 1, 1} * static_cast<float>(x + 1);
  EXPECT_NEAR(exposure_from(image), 1.0 / 99, 1e-6);
  const DisplayImage shown = expose(image, 0.02f);
  EXPECT_EQ(shown.at(99, 0).r, 1);
  EXPECT_FLOAT_EQ(shown.at(24, 0).r, gamma_encode(0.5f));
}

TEST(Colour, ExposureIgnoresWhatIsNoRadiance) {
  SceneImage image(4, 1);
  image.at(0, 0) = {std::nanf(""), 1, 1};
  image.at(1, 0) = {kInf, kInf, kInf};
  image.at(2, 0) = {-3, -3, -3};
  EXPECT_EQ(exposure_from(image), 1);
  image.at(3, 0) = {4, 4, 4};
  EXPECT_NEAR(exposure_from(image), 0.25, 1e-6);
  EXPECT_EQ(exposure_from(SceneImage()), 1);
  const DisplayImage shown = expose(image, 1);
  for (const Rgb& c : shown.pixels())
    for (const float v : {c.r, c.g, c.b}) EXPECT_TRUE(v >= 0 && v <= 1) << v;
}

TEST(Repair, EveryKindOfDefectIsReplacedAndCounted) {
  SceneImage image(3, 1);
  image.at(0, 0) = {std::nanf(""), kInf, -kInf};
  image.at(1, 0) = {-2, 5, -0.0f};
  image.at(2, 0) = {1e9f, 0, 1e-9f};
  const PixelRepairs expected{.nan = 1, .positive_infinity = 1, .negative = 2};
  EXPECT_EQ(count_defects(image), expected);
  EXPECT_EQ(repair(image), expected);
  EXPECT_EQ(image.at(0, 0), (Rgb{0, 1e9f, 0}));
  EXPECT_EQ(image.at(1, 0), (Rgb{0, 5, 0}));
  EXPECT_EQ(image.at(2, 0), (Rgb{1e9f, 0, 1e-9f}));
  EXPECT_EQ(repair(image).total(), 0);
}

TEST(Repair, AnImageOfNothingButDefectsBecomesBlack) {
  SceneImage image(2, 2, {kInf, std::nanf(""), -1});
  EXPECT_EQ(repair(image).total(), 12);
  EXPECT_EQ(image, SceneImage(2, 2));
}

}  // namespace
}  // namespace plenolab
