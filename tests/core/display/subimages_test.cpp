#include "core/display/subimages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

DisplayImage constant_per_subimage(const SubimageLayout& layout) {
  DisplayImage image(layout.width(), layout.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto number = static_cast<float>((y / layout.size_px) * layout.columns + x / layout.size_px);
      image.at(x, y) = {number / 128, 1 - number / 128, 0.3f};
    }
  return image;
}

TEST(Subimages, KeepTheirConstantsWhenHalvedBecauseNeighboursDoNotMix) {
  const SubimageLayout layout{5, 3, 8}, half{5, 3, 4};
  const DisplayImage halved = halve_subimages(constant_per_subimage(layout), layout, 2);
  const DisplayImage expected = constant_per_subimage(half);
  ASSERT_EQ(halved.size(), expected.size());
  for (std::size_t i = 0; i < halved.size(); ++i) {
    EXPECT_NEAR(halved.pixels()[i].r, expected.pixels()[i].r, 1e-6f);
    EXPECT_NEAR(halved.pixels()[i].g, expected.pixels()[i].g, 1e-6f);
  }
}

TEST(Subimages, AreHalvedByTheMeanOfPixels2iMinus1To2iPlus2) {
  const SubimageLayout layout{1, 1, 8};
  DisplayImage image(8, 8);
  image.at(3, 3) = {1, 1, 1};  // within 2i − 1 … 2i + 2 of outputs 1 and 2 on either axis
  const DisplayImage halved = halve_subimages(image, layout);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const bool covered = (x == 1 || x == 2) && (y == 1 || y == 2);
      EXPECT_FLOAT_EQ(halved.at(x, y).r, covered ? 1.0f / 16 : 0.0f) << x << ", " << y;
    }
  DisplayImage corner(8, 8);
  corner.at(0, 0) = {1, 1, 1};  // stands in for what lies beyond the border
  EXPECT_FLOAT_EQ(halve_subimages(corner, layout).at(0, 0).r, 4.0f / 16);
}

TEST(Subimages, RefuseToBeHalvedAtAnOddSizeOrInAnotherLayout) {
  EXPECT_THROW(halve_subimages(DisplayImage(9, 9), {1, 1, 9}), InputError);
  EXPECT_THROW(halve_subimages(DisplayImage(8, 8), {2, 2, 8}), InputError);
  EXPECT_THROW(subimage(DisplayImage(16, 16), {2, 2, 8}, 2, 0), InputError);
}

TEST(Subimages, StandOnThePanelAtTheThesisPitchWithBlackAround) {
  const SubimageLayout layout{15, 8, 81};
  const DisplayImage panel = panel_image(constant_per_subimage(layout), layout, {});
  EXPECT_EQ(panel.width(), 1280);
  EXPECT_EQ(panel.height(), 720);
  // 1205 × 642 2/3 px, centred: columns 37.5 to 1242.5, rows 38 2/3 to 681 1/3.
  EXPECT_EQ(panel.at(36, 360), Rgb{});
  EXPECT_EQ(panel.at(640, 37), Rgb{});
  EXPECT_GT(panel.at(38, 360).b, 0.29f);
  EXPECT_GT(panel.at(1241, 360).b, 0.29f);
  EXPECT_EQ(panel.at(1243, 360), Rgb{});
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 15; ++column) {
      const auto x = static_cast<int>(37.5 + (column + 0.5) * (80 + 1.0 / 3)),
                 y = static_cast<int>(720 / 2.0 + (row + 0.5 - 4) * (80 + 1.0 / 3));
      EXPECT_NEAR(panel.at(x, y).r, static_cast<float>(row * 15 + column) / 128, 1e-6f);
    }
}

TEST(Subimages, NeverMixOnThePanel) {
  const SubimageLayout layout{15, 8, 27};
  const DisplayImage light_field = constant_per_subimage(layout);
  const DisplayImage panel = panel_image(light_field, layout, {});
  for (const Rgb& c : panel.pixels()) {
    if (c == Rgb{}) continue;
    const float number = c.r * 128;
    ASSERT_NEAR(number, std::round(number), 1e-4f) << "a mixture of two subimages";
  }
}

TEST(Subimages, RefuseAPanelWithAnotherNumberOfLenses) {
  EXPECT_THROW(panel_image(DisplayImage(20, 20), {2, 2, 10}, {}), InputError);
}

TEST(Subimages, DoNotDependOnTheNumberOfThreads) {
  const SubimageLayout layout{3, 2, 20};
  DisplayImage image(layout.width(), layout.height());
  RandomStream random(1, 2, 3);
  for (Rgb& c : image.pixels()) c = {random.next_float(), random.next_float(), random.next_float()};
  EXPECT_EQ(halve_subimages(image, layout, 1), halve_subimages(image, layout, 2));
  const NearEyeDisplay display{.columns = 3, .rows = 2};
  EXPECT_EQ(panel_image(image, layout, display, 1), panel_image(image, layout, display, 2));
}

}  // namespace
}  // namespace plenolab
