#include "core/image/cielab.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace plenolab {
namespace {

TEST(CieLab, HasThePublishedCoordinatesOfThePrimaries) {
  // Linear BT.709 primaries at D65 (Lindbloom's calculator, sRGB reference white D65): red 53.24 80.09 67.20,
  // green 87.74 −86.18 83.18, blue 32.30 79.19 −107.86.
  const CieLab red = lab_of_display({1, 0, 0}), green = lab_of_display({0, 1, 0}),
               blue = lab_of_display({0, 0, 1});
  EXPECT_NEAR(red.l, 53.24, 0.02);
  EXPECT_NEAR(red.a, 80.09, 0.05);
  EXPECT_NEAR(red.b, 67.20, 0.05);
  EXPECT_NEAR(green.l, 87.74, 0.02);
  EXPECT_NEAR(green.a, -86.18, 0.05);
  EXPECT_NEAR(green.b, 83.18, 0.05);
  EXPECT_NEAR(blue.l, 32.30, 0.02);
  EXPECT_NEAR(blue.a, 79.19, 0.05);
  EXPECT_NEAR(blue.b, -107.86, 0.05);
}

TEST(CieLab, WhiteAndGreysAreNeutralAndEverythingComesBack) {
  const CieLab white = lab_of_display({1, 1, 1}), black = lab_of_display({0, 0, 0});
  EXPECT_NEAR(white.l, 100, 1e-9);
  EXPECT_NEAR(black.l, 0, 1e-9);
  const CieLab grey = lab_of_display({0.3f, 0.3f, 0.3f});
  EXPECT_NEAR(grey.a, 0, 1e-6);
  EXPECT_NEAR(grey.b, 0, 1e-6);
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(1, 1, i);
    const Rgb c{random.next_float(), random.next_float(), random.next_float()};
    const Rgb again = display_of_lab(lab_of_display(c));
    EXPECT_NEAR(again.r, c.r, 1e-5);
    EXPECT_NEAR(again.g, c.g, 1e-5);
    EXPECT_NEAR(again.b, c.b, 1e-5);
  }
}

TEST(CieLab, TheDifferenceOfColoursIsTheirDistance) {
  EXPECT_DOUBLE_EQ(delta_e({50, 2, 3}, {50, 2, 3}), 0);
  EXPECT_DOUBLE_EQ(delta_e({50, 0, 0}, {52, 3, -6}), 7);
  EXPECT_NEAR(delta_e(lab_of_display({0, 0, 0}), lab_of_display({1, 1, 1})), 100, 1e-9);
}

}  // namespace
}  // namespace plenolab
