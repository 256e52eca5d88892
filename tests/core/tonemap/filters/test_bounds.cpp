#include <gtest/gtest.h>

#include <limits>

#include "core/tonemap/filters/bounds.h"

namespace plenolab {
namespace {

TEST(Bounds, ExtremesAndBadValuesAreFoundAtEveryPlace) {
  for (int place = 0; place < 19; ++place) {
    Plane<float> plane(19, 1, 2.0f);
    plane.at(place, 0) = -3;
    EXPECT_EQ(bounds_of(plane), (Bounds{-3, 2, true})) << place;
    plane.at(place, 0) = 5;
    EXPECT_EQ(bounds_of(plane), (Bounds{2, 5, true})) << place;
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 2e18f, -2e18f}) {
      plane.at(place, 0) = bad;
      EXPECT_FALSE(bounds_of(plane).usable) << place << ' ' << bad;
    }
  }
}

TEST(Bounds, RangeOfTheLargestValuesDoesNotOverflow) {
  Plane<float> plane(2, 1, -kLargestFiltered);
  plane.at(1, 0) = kLargestFiltered;
  EXPECT_TRUE(bounds_of(plane).usable);
  EXPECT_NEAR(bounds_of(plane).range(), 2e18, 1e12);
}

}  // namespace
}  // namespace plenolab
