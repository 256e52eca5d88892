#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/image/colour.h"
#include "core/tonemap/statistics.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

TEST(ToneStatistics, AveragesAndExtremesMatchAHandComputedImage) {
  SceneImage image(2, 2);
  image.at(0, 0) = {10, 10, 10};
  image.at(1, 0) = {0.1f, 0.1f, 0.1f};
  image.at(0, 1) = {1, 2, 3};
  const double l = static_cast<double>(luminance({1, 2, 3}));
  const ViewStatistics s = measure_view(image);
  EXPECT_EQ(s.pixels, 4);
  EXPECT_EQ(s.zero_pixels, 1);
  EXPECT_NEAR(log_floor(s), 0.1, 1e-8);
  const ImageStatistics e = evaluate(s, 0.01);
  EXPECT_NEAR(e.average_colour[2], 13.1 / 4, 1e-7);
  EXPECT_NEAR(e.average_luminance, (10.1 + l) / 4, 1e-6);
  EXPECT_NEAR(e.log_average, (1 - 1 + std::log10(l) - 2) / 4, 1e-6);
  EXPECT_NEAR(e.log_min, -2, 1e-12);
  EXPECT_NEAR(e.log_max, 1, 1e-7);
}

TEST(ToneStatistics, PercentilesAreThoseOfTheSortedPositivePixels) {
  SceneImage image = random_scene(80, 61);
  std::vector<double> sorted;
  for (const Rgb& c : image.pixels()) sorted.push_back(static_cast<double>(luminance(c)));
  std::sort(sorted.begin(), sorted.end());
  for (int x = 0; x < 20; ++x) image.at(x, 3) = image.at(x + 20, 3);  // a few ties
  const ImageStatistics e = evaluate(measure_view(image), 1e-3);
  EXPECT_NEAR(e.log_p1, std::log10(quantile_of_sorted<double>(sorted, 0.01)), 0.02);
  EXPECT_NEAR(e.log_p99, std::log10(quantile_of_sorted<double>(sorted, 0.99)), 0.02);
  EXPECT_GT(e.log_p1, e.log_min);
  EXPECT_LT(e.log_p99, e.log_max);
}

TEST(ToneStatistics, MergingViewsEqualsMeasuringThemAsOne) {
  const SceneImage whole = random_scene(32, 24);
  SceneImage top(32, 10), bottom(32, 14);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) (y < 10 ? top.at(x, y) : bottom.at(x, y - 10)) = whole.at(x, y);
  const ViewStatistics merged = merge(measure_view(top), measure_view(bottom)), one = measure_view(whole);
  EXPECT_EQ(merged.pixels, one.pixels);
  EXPECT_EQ(merged.bins, one.bins);
  EXPECT_EQ(merged.min_positive, one.min_positive);
  EXPECT_EQ(merged.max_luminance, one.max_luminance);
  EXPECT_NEAR(merged.log10_sum, one.log10_sum, 1e-9 * std::abs(one.log10_sum));
  EXPECT_NEAR(merged.luminance_sum, one.luminance_sum, 1e-12 * one.luminance_sum);
}

TEST(ToneStatistics, AreTheSameBitsForAnyNumberOfThreads) {
  const SceneImage image = random_scene(61, 47);
  const ViewStatistics one = measure_view(image, 1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(measure_view(image, threads), one) << threads;
}

TEST(ToneStatistics, DefectsCountAsRepairReplacesThem) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  SceneImage image(2, 2, Rgb{1, 1, 1});
  image.at(0, 0) = {nan, nan, nan};
  image.at(1, 0) = {inf, inf, inf};
  image.at(0, 1) = {-1, -inf, 4};
  const ViewStatistics s = measure_view(image);
  EXPECT_EQ(s.repairs, (PixelRepairs{.nan = 3, .positive_infinity = 3, .negative = 2}));
  EXPECT_EQ(s.zero_pixels, 1);
  EXPECT_NEAR(s.max_luminance, 4, 1e-6);
}

TEST(ToneStatistics, OfAConstantImageAllLogsAreEqual) {
  const ViewStatistics s = measure_view(SceneImage(13, 9, Rgb{0.37f, 0.37f, 0.37f}));
  const ImageStatistics e = evaluate(s, log_floor(s));
  for (const double v : {e.log_average, e.log_max, e.log_p1, e.log_p99, e.log_robust_average})
    EXPECT_EQ(v, e.log_min);
}

TEST(ToneStatistics, OfABlackViewAreTheFloor) {
  const ViewStatistics s = measure_view(SceneImage(3, 3));
  EXPECT_EQ(log_floor(s), 1);
  const ImageStatistics e = evaluate(s, 0.01);
  EXPECT_EQ(e.average_luminance, 0);
  for (const double v : {e.log_average, e.log_min, e.log_max, e.log_p1, e.log_p99, e.log_robust_average})
    EXPECT_NEAR(v, -2, 1e-12);
}

TEST(ToneStatistics, RobustAverageHardlyMovesWithAnOutlierAndNotWithBlackPixels) {
  SceneImage image = random_scene(64, 64);
  const double before = evaluate(measure_view(image), 1e-3).log_robust_average;
  for (int i = 0; i < 8; ++i) image.at(8 * i, i) = {1e30f, 1e30f, 1e30f};  // 0.2 % of the pixels
  const ImageStatistics bright = evaluate(measure_view(image), 1e-3);
  EXPECT_NEAR(bright.log_robust_average, before, 0.01);
  EXPECT_GT(bright.log_max, 29);
  for (int x = 0; x < 64; ++x) image.at(x, 63) = {};
  EXPECT_NEAR(evaluate(measure_view(image), 1e-3).log_robust_average, before, 0.02);
}

TEST(ToneStatistics, BlendIsLinearAndExactAtACorner) {
  const ImageStatistics a = evaluate(measure_view(random_scene(16, 16, 3)), 1e-3);
  const ImageStatistics b = evaluate(measure_view(random_scene(16, 16, 5, 10)), 1e-3);
  EXPECT_EQ(blend(std::vector{a, b}, std::vector{1.0, 0.0}), a);
  const ImageStatistics mean = blend(std::vector{a, b}, std::vector{0.25, 0.75});
  EXPECT_NEAR(mean.log_p99, 0.25 * a.log_p99 + 0.75 * b.log_p99, 1e-14);
  EXPECT_NEAR(mean.average_colour[1], 0.25 * a.average_colour[1] + 0.75 * b.average_colour[1], 1e-10);
}

TEST(ToneStatistics, BadWeightsFloorsAndEmptyImagesAreErrors) {
  const ImageStatistics a;
  EXPECT_THROW(blend(std::vector{a, a}, std::vector{0.5, 0.6}), InputError);
  EXPECT_THROW(blend(std::vector{a, a}, std::vector{1.5, -0.5}), InputError);
  EXPECT_THROW(blend(std::vector{a, a}, std::vector{1.0}), InputError);
  EXPECT_THROW(evaluate(measure_view(SceneImage()), 1), InputError);
  EXPECT_THROW(evaluate(measure_view(SceneImage(1, 1)), 0), InputError);
  EXPECT_THROW(evaluate(measure_view(SceneImage(1, 1)), std::nan("")), InputError);
}

}  // namespace
}  // namespace plenolab
