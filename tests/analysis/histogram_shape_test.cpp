#include "analysis/histogram_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace plenolab {
namespace {

/// A plane whose log10 luminances are `log10_of` a uniform number in [0, 1).
template <class Function>
Plane<float> plane_of(Function log10_of, int side = 300) {
  Plane<float> plane(side, side);
  std::uint64_t n = 0;
  for (float& v : plane.pixels())
    v = static_cast<float>(std::pow(10.0, log10_of(unit_double(random_u64(1, 77, n++)))));
  return plane;
}

TEST(HistogramShape, OfEvenlySpreadLuminancesIsFlat) {
  const auto shape = histogram_shape(plane_of([](double u) { return 4 * u - 2; }));
  ASSERT_TRUE(shape);
  EXPECT_NEAR(std::accumulate(shape->shares.begin(), shape->shares.end(), 0.0), 1, 1e-12);
  EXPECT_NEAR(shape->log10_high - shape->log10_low, 4 * 0.99, 0.02);
  EXPECT_NEAR(shape->concentration, 26.0 / 256, 0.02);
  EXPECT_LT(shape->jaggedness, 0.03);
}

TEST(HistogramShape, OfOneLuminanceIsASpike) {
  const auto shape = histogram_shape(Plane<float>(20, 20, 3.0f));
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->concentration, 1);
  // All but what a Gaussian of 4 bins leaves in place, at an end of the range twice: 2/(4·√(2π)).
  EXPECT_NEAR(shape->jaggedness, 1 - 2 / (4 * std::sqrt(2 * M_PI)), 0.01);
}

TEST(HistogramShape, KnowsConcentrationFromJaggedness) {
  // A narrow smooth peak with tails is concentrated, evenly spaced spikes are jagged.
  const auto peak = histogram_shape(plane_of([](double u) { return 3 * std::pow(2 * u - 1, 5); }));
  const auto comb = histogram_shape(plane_of([](double u) { return std::floor(32 * u) / 8; }));
  ASSERT_TRUE(peak && comb);
  EXPECT_GT(peak->concentration, 0.5);
  EXPECT_GT(comb->jaggedness, 0.4);
  EXPECT_LT(peak->jaggedness, comb->jaggedness / 2);
}

TEST(HistogramShape, DoesNotDependOnTheUnitNorOnBlackPixels) {
  Plane<float> plane = plane_of([](double u) { return 3 * u * u; }, 100);
  const auto before = histogram_shape(plane);
  Plane<float> scaled(100, 101);
  for (std::size_t i = 0; i < plane.size(); ++i) scaled.pixels()[i] = plane.pixels()[i] * 1024;
  const auto after = histogram_shape(scaled);  // with a row of zeros
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(before->concentration, after->concentration, 1e-3);
  EXPECT_NEAR(before->jaggedness, after->jaggedness, 1e-2);
}

TEST(HistogramShape, OfTwoLuminancesIsTwoSpikes) {
  Plane<float> image(2, 1, 1.0f);
  image.at(1, 0) = 100;
  const auto shape = histogram_shape(image);
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->concentration, 1, 1e-9);
  EXPECT_GT(shape->jaggedness, 0.8);
  EXPECT_LE(shape->jaggedness, 1);
}

TEST(HistogramShape, OfABlackImageIsNone) {
  EXPECT_FALSE(histogram_shape(Plane<float>(4, 4)));
  EXPECT_FALSE(histogram_shape(Plane<float>()));
}

}  // namespace
}  // namespace plenolab
