#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/tonemap/filters/bilateral_filter.h"
#include "tests/core/tonemap/filters/filter_images.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

double gaussian(double x, double sigma) {
  return std::exp(-x * x / (2 * sigma * sigma));
}

double depth_weight(const DepthGuide& depth, int px, int py, int qx, int qy) {
  double d =
      static_cast<double>(depth.disparity->at(qx, qy)) - static_cast<double>(depth.disparity->at(px, py));
  if (depth.side == DepthSide::kBackgroundTakesNothingFromForeground) d = std::max(d, 0.0);
  return gaussian(d, depth.sigma_d_px);
}

/// The definition, in double precision.
double filtered_pixel(const Plane<float>& value, const Plane<float>& range, const BilateralOptions& o,
                      const std::optional<DepthGuide>& depth, int x, int y) {
  const int r = static_cast<int>(std::ceil(o.support_sigmas * o.sigma_s_px));
  double weights = 0, sum = 0;
  for (int qy = std::max(0, y - r); qy <= std::min(value.height() - 1, y + r); ++qy)
    for (int qx = std::max(0, x - r); qx <= std::min(value.width() - 1, x + r); ++qx) {
      double w = gaussian(std::hypot(qx - x, qy - y), o.sigma_s_px) *
                 gaussian(static_cast<double>(range.at(qx, qy)) - static_cast<double>(range.at(x, y)),
                          o.sigma_value);
      if (depth) w *= depth_weight(*depth, x, y, qx, qy);
      weights += w;
      sum += w * static_cast<double>(value.at(qx, qy));
    }
  return sum / weights;
}

TEST(BilateralExact, IsTheDefinitionForEveryDepthWeight) {
  const FilterImage image = discs_before_ground(61, 37);
  const FilterImage other = discs_before_ground(61, 37);
  const BilateralOptions options{.sigma_s_px = 3.3, .sigma_value = 0.4, .support_sigmas = 2.5};
  for (const std::optional<DepthGuide>& depth :
       {std::optional<DepthGuide>{}, std::optional(DepthGuide{&image.disparity, 0.5, DepthSide::kTwoSided}),
        std::optional(DepthGuide{&image.disparity, 2, DepthSide::kBackgroundTakesNothingFromForeground})}) {
    const Plane<float> result = bilateral_exact(image.value, options, depth);
    for (int y = 0; y < result.height(); y += 4)
      for (int x = 0; x < result.width(); x += 3)
        EXPECT_NEAR(static_cast<double>(result.at(x, y)),
                    filtered_pixel(image.value, image.value, options, depth, x, y), 4e-6)
            << x << ' ' << y;
  }
}

TEST(BilateralExact, AveragesValuesByTheRangeOfAnotherPlane) {
  const FilterImage image = discs_before_ground(33, 21);
  Plane<float> value(33, 21);
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 33; ++x) value.at(x, y) = static_cast<float>(noise(9, x, y));
  const BilateralOptions options{.sigma_s_px = 2, .sigma_value = 0.3};
  const Plane<float> result = cross_bilateral_exact(value, image.value, options);
  for (int y = 0; y < 21; y += 2)
    for (int x = 0; x < 33; x += 2)
      EXPECT_NEAR(static_cast<double>(result.at(x, y)),
                  filtered_pixel(value, image.value, options, std::nullopt, x, y), 1e-6);
}

TEST(BilateralExact, TwoPixelsMixByTheProductOfTheirWeights) {
  Plane<float> pair(2, 1);
  pair.at(1, 0) = 0.5f;
  const Plane<float> result = bilateral_exact(pair, {.sigma_s_px = 1.5, .sigma_value = 0.4});
  const double w = std::exp(-1 / 4.5 - 0.25 / 0.32);
  EXPECT_NEAR(static_cast<double>(result.at(0, 0)), 0.5 * w / (1 + w), 1e-7);
  EXPECT_NEAR(static_cast<double>(result.at(1, 0)), 0.5 / (1 + w), 1e-7);
}

TEST(BilateralExact, EdgesFarAboveSigmaStayAndOnesFarBelowBlur) {
  const FilterImage high = depth_step(40, 8, 3, 0), low = depth_step(40, 8, 0.01f, 0);
  const BilateralOptions options{.sigma_s_px = 4, .sigma_value = 0.4};
  EXPECT_LT(difference(bilateral_exact(high.value, options), high.value).max, 1e-5);
  const Plane<float> blurred = bilateral_exact(low.value, options);
  EXPECT_NEAR(static_cast<double>(blurred.at(19, 4)), 0.0055, 3e-4);
  EXPECT_NEAR(static_cast<double>(blurred.at(20, 4)), 0.0045, 3e-4);
}

TEST(BilateralExact, TwoSidedWeightLetsNothingCrossADepthEdge) {
  const FilterImage step = depth_step(40, 8, 0.2f, 0);
  const Plane<float> result =
      bilateral_exact(step.value, {.sigma_s_px = 4}, DepthGuide{&step.disparity, 0.5, DepthSide::kTwoSided});
  EXPECT_LT(difference(result, step.value).max, 1e-7);
}

TEST(BilateralExact, OneSidedWeightKeepsTheBackgroundAndBlursTheForegroundAsWithoutDepth) {
  const FilterImage step = depth_step(40, 8, 0.2f, 0);
  const BilateralOptions options{.sigma_s_px = 4};
  const Plane<float> plain = bilateral_exact(step.value, options);
  const Plane<float> result =
      bilateral_exact(step.value, options,
                      DepthGuide{&step.disparity, 0.5, DepthSide::kBackgroundTakesNothingFromForeground});
  EXPECT_GT(plain.at(20, 4), 0.05f);  // without depth the background takes from the foreground
  for (int x = 0; x < 40; ++x) {
    EXPECT_NEAR(static_cast<double>(result.at(x, 4)), x < 20 ? static_cast<double>(plain.at(x, 4)) : 0, 1e-7)
        << x;
  }
}

TEST(BilateralExact, WidthsAreChecked) {
  const Plane<float> image(3, 3);
  EXPECT_EQ(message_of([&] { bilateral_exact(image, {.sigma_s_px = 0}); }),
            "the bilateral filter's sigma in pixels must be between 1e-09 and 1000000000, not 0");
  EXPECT_EQ(message_of([&] { bilateral_exact(image, {.sigma_value = std::nan("")}); }),
            "the bilateral filter's sigma of the values must be between 1e-09 and 1000000000, not nan");
  EXPECT_EQ(message_of([&] { bilateral_exact(image, {.support_sigmas = 11}); }),
            "the support of the bilateral filter must be 1 to 10 sigmas, not 11");
  const DepthGuide depth{&image, -1};
  EXPECT_EQ(message_of([&] { bilateral_exact(image, {}, depth); }),
            "the bilateral filter's sigma of the disparity must be between 1e-09 and 1000000000, not -1");
}

TEST(BilateralExact, ValuesThatAreNotFiniteAndPlanesOfOtherSizesAreBugs) {
  Plane<float> image(3, 3);
  const Plane<float> other(3, 2);
  EXPECT_THROW(cross_bilateral_exact(image, other, {}), std::logic_error);
  EXPECT_THROW(bilateral_fast(image, {}, DepthGuide{&other}), std::logic_error);
  EXPECT_THROW(bilateral_fast(image, {}, DepthGuide{}), std::logic_error);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    image.at(1, 1) = bad;
    EXPECT_THROW(bilateral_exact(image, {}), std::logic_error);
    EXPECT_THROW(bilateral_fast(image, {}), std::logic_error);
  }
}

TEST(BilateralExact, DefaultWidthIsTwoPerCentOfTheLargerSide) {
  EXPECT_DOUBLE_EQ(default_sigma_s_px(1920, 1080), 38.4);
  EXPECT_DOUBLE_EQ(default_sigma_s_px(100, 500), 10);
}

}  // namespace
}  // namespace plenolab
