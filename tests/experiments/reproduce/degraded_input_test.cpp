#include "experiments/reproduce/display/degraded_input.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plenolab {
namespace {

TEST(CodedDepth, KeepsTheClippingPlanesAndClipsBeyond) {
  for (const DepthCoding& coding : kDepthCodings) {
    EXPECT_NEAR(coded_depth(0.1f, coding), 0.1, 1e-6) << coding.name;
    EXPECT_NEAR(coded_depth(10, coding), 10, 1e-2) << coding.name;
    EXPECT_EQ(coded_depth(0.05f, coding), coded_depth(0.1f, coding)) << coding.name;
    EXPECT_EQ(coded_depth(INFINITY, coding), coded_depth(10, coding)) << coding.name;
  }
}

TEST(CodedDepth, IsOffByHalfAStepAtMostOnItsOwnScale) {
  for (const DepthCoding& coding : kDepthCodings) {
    if (coding.bits == 0) continue;
    const double half_step = 0.5 / (std::pow(2.0, coding.bits) - 1);
    double largest = 0;
    for (double z = 0.11; z < 9.9; z *= 1.01) {
      const double back = coded_depth(static_cast<float>(z), coding);
      const double off = coding.scale == DepthCoding::Scale::kLinear
                             ? std::abs(back - z) / (kCodedFar_m - kCodedNear_m)
                             : std::abs(1 / back - 1 / z) / (1 / kCodedNear_m - 1 / kCodedFar_m);
      largest = std::max(largest, off);
    }
    EXPECT_LE(largest, 1.01 * half_step + 1e-7) << coding.name;
    if (coding.bits == 8) {
      EXPECT_GT(largest, 0.5 * half_step) << coding.name << " does not round at all";
    }
  }
}

TEST(CodedDepth, OfAFloatZBufferIsExactToAMillionthNear) {
  EXPECT_NEAR(coded_depth(0.12f, kDepthCodings.back()), 0.12, 1e-7);
}

RenderedCamera camera(int size, float left_m, float right_m) {
  RenderedCamera c{0, 0, DisplayImage(size, size), Plane<float>(size, size)};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const bool left = x < size / 2 - 1;
      c.depth_m.at(x, y) = left ? left_m : right_m;
      c.colour.at(x, y) = left ? Rgb{0, 0, 0} : Rgb{1, 1, 1};
    }
  return c;
}

TEST(AntiAliased, AveragesColourAndDepthOnlyIfAsked) {
  const RenderedCamera sharp = camera(4, 1, 3), fine = camera(8, 1, 3);  // the edge of `fine` is in pixel 1
  const RenderedCamera colour = anti_aliased(sharp, fine, false), both = anti_aliased(sharp, fine, true);
  EXPECT_FLOAT_EQ(colour.colour.at(0, 0).r, 0);
  EXPECT_FLOAT_EQ(colour.colour.at(1, 0).r, 0.5f);
  EXPECT_FLOAT_EQ(colour.colour.at(2, 0).r, 1);
  EXPECT_EQ(colour.depth_m, sharp.depth_m);
  EXPECT_EQ(both.colour.at(1, 0).r, colour.colour.at(1, 0).r);
  EXPECT_FLOAT_EQ(both.depth_m.at(1, 0), 2) << "between the surfaces, where nothing is";
}

TEST(StrayShare, CountsMatchesWhoseDepthNothingAroundHas) {
  Plane<float> truth(8, 4, 1.0f), taken = truth;
  EXPECT_EQ(stray_share(taken, truth, 4), 0);
  taken.at(1, 1) = 2;
  taken.at(2, 2) = 1.04f;  // within 5 %
  taken.at(0, 0) = -1;     // a hole
  EXPECT_DOUBLE_EQ(stray_share(taken, truth, 4), 1.0 / 31);
  truth.at(2, 1) = 2;  // beside it
  EXPECT_EQ(stray_share(taken, truth, 4), 0);
  taken.at(3, 3) = 2;
  truth.at(4, 3) = 2;  // beside it, but in the next subimage
  EXPECT_DOUBLE_EQ(stray_share(taken, truth, 4), 1.0 / 31);
}

}  // namespace
}  // namespace plenolab
