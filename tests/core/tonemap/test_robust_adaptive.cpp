#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/eye_average.h"
#include "core/tonemap/reinhard_devlin.h"
#include "core/tonemap/robust_adaptive.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

ImageStatistics statistics_of(const SceneImage& image) {
  const ViewStatistics s = measure_view(image);
  return evaluate(s, log_floor(s));
}

RobustAdaptiveParameters fitted(const SceneImage& image) {
  const ImageStatistics statistics = statistics_of(image);
  return fit(RobustAdaptiveOptions{}, statistics, log_eye_average(eye_average(image), statistics));
}

DisplayImage mapped(const SceneImage& image) {
  return apply(fitted(image), image).image;
}

/// Naive Reinhard & Devlin of the same image, for comparison.
DisplayImage devlin(const SceneImage& image) {
  const ReinhardDevlinParameters p = fit(ReinhardDevlinOptions{}, statistics_of(image));
  return apply(p, measure_limits(p, image), image).image;
}

double mean_change(const DisplayImage& a, const DisplayImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(static_cast<double>(a.pixels()[i].g) - static_cast<double>(b.pixels()[i].g));
  return sum / static_cast<double>(a.size());
}

double mean_green(const DisplayImage& image) {
  double sum = 0;
  for (const Rgb& c : image.pixels()) sum += static_cast<double>(c.g);
  return sum / static_cast<double>(image.size());
}

TEST(RobustAdaptive, AFewOutliersHardlyChangeItWhileTheyChangeReinhardDevlin) {
  const SceneImage image = random_scene(64, 48, 2, 10);
  SceneImage with = image;
  for (int i = 0; i < 5; ++i) with.at(7 * i, 9 * i) = {1e6f, 1e6f, 1e6f};  // 0.16 % of the pixels
  const double ours = mean_change(mapped(image), mapped(with)),
               theirs = mean_change(devlin(image), devlin(with));
  EXPECT_LT(ours, 0.005);
  EXPECT_GT(theirs, 0.05);
}

TEST(RobustAdaptive, FollowsLightThatFillsAFewPercentOfTheView) {
  const SceneImage image = random_scene(64, 48, 2, 10);
  SceneImage window = image;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) window.at(x, y) = {1e4f, 1e4f, 1e4f};  // 6 % of the view
  EXPECT_GT(mean_change(mapped(image), mapped(window)), 0.05);
  EXPECT_GT(mapped(image).at(40, 40).g, mapped(window).at(40, 40).g);
}

TEST(RobustAdaptive, FollowsASunOfAFewPixelsButNoSpecks) {
  const SceneImage image = random_scene(64, 48, 2, 10);
  SceneImage sun = image, specks = image;
  for (int i = 0; i < 4; ++i) sun.at(20 + i % 2, 20 + i / 2) = {1e8f, 1e8f, 1e8f};  // 0.13 % of the view
  for (int i = 0; i < 4; ++i) specks.at(10 * i, 20) = {1e8f, 1e8f, 1e8f};
  EXPECT_LT(mean_green(mapped(sun)), mean_green(mapped(image)) - 0.03);
  EXPECT_NEAR(mean_green(mapped(specks)), mean_green(mapped(image)), 0.01);
  EXPECT_GT(mapped(sun).at(20, 20).g, 0.95f);
}

TEST(EyeAverage, IsTheMeanOfSmoothViewsAndCountsCompactSourcesWhole) {
  const SceneImage ramp = grey_image(9, 7, [](int x, int y) { return 1.0f + static_cast<float>(x + y); });
  EXPECT_NEAR(eye_average(ramp), 8, 0.05);  // the two brightest corners count as their neighbours
  SceneImage source = grey_image(10, 10, [](int, int) { return 0.0f; });
  for (int x = 4; x < 7; ++x) source.at(x, 5) = {100, 100, 100};
  EXPECT_NEAR(eye_average(source), 1, 1e-5);  // the ends of a line see only two of its pixels
  source.at(4, 6) = source.at(5, 6) = source.at(6, 6) = {100, 100, 100};
  EXPECT_NEAR(eye_average(source), 6, 1e-5);
}

TEST(EyeAverage, LeavesOutOneOrTwoPixelsOfAnySizeAndRepairsDefects) {
  SceneImage image = grey_image(12, 10, [](int, int) { return 2.0f; });
  image.at(5, 5) = image.at(6, 5) = image.at(0, 0) = {1e30f, 1e30f, 1e30f};
  image.at(9, 8) = {INFINITY, NAN, -1};
  EXPECT_NEAR(eye_average(image), 2, 1e-5);
  EXPECT_EQ(eye_average(SceneImage(3, 3)), 0);
  EXPECT_EQ(eye_average(SceneImage()), 0);
  EXPECT_NEAR(eye_average(grey_image(1, 1, [](int, int) { return 3.0f; })), 3, 1e-5);
}

TEST(RobustAdaptive, PercentilesGetTheLumaOfToeAndShoulderAndNothingIsClipped) {
  const SceneImage image =
      grey_image(1000, 1, [](int x, int) { return static_cast<float>(std::pow(10, 3.0 * x / 999)); });
  const ToneMapped out = apply(fitted(image), image);
  EXPECT_NEAR(out.image.at(10, 0).g, 0.03, 0.003);
  EXPECT_NEAR(out.image.at(989, 0).g, 0.92, 0.003);
  EXPECT_LT(out.image.at(999, 0).g, 1);
  for (int x = 1; x < 1000; ++x) EXPECT_GT(out.image.at(x, 0).g, out.image.at(x - 1, 0).g);
  EXPECT_EQ(out.counts, MappingCounts{});
}

TEST(RobustAdaptive, DoesNotDependOnTheUnit) {
  const SceneImage image = random_scene(40, 30);
  SceneImage other = image;
  for (Rgb& c : other.pixels()) c = 1024.0f * c;
  EXPECT_LT(mean_change(mapped(image), mapped(other)), 1e-5);
}

TEST(RobustAdaptive, FlatViewsStayFlat) {
  const auto noise = [](int x, int y) {
    return 5.0f * (1 + 0.01f * unit_float(random_u64(1, 1, static_cast<std::uint64_t>(50 * y + x))));
  };
  const DisplayImage out = mapped(grey_image(50, 50, noise));
  double low = 1, high = 0;
  for (const Rgb& c : out.pixels()) {
    low = std::min(low, static_cast<double>(c.g));
    high = std::max(high, static_cast<double>(c.g));
  }
  EXPECT_LT(high - low, 0.02);
  EXPECT_NEAR((low + high) / 2, 0.475, 0.03);
}

TEST(RobustAdaptive, OptionsOutOfRangeAreErrors) {
  EXPECT_THROW((RobustAdaptiveOptions{.brightness = NAN}.validate()), InputError);
  EXPECT_THROW((RobustAdaptiveOptions{.toe = 0.5}.validate()), InputError);
  EXPECT_THROW((RobustAdaptiveOptions{.shoulder = -0.1}.validate()), InputError);
  EXPECT_THROW((RobustAdaptiveOptions{.max_slope = 0}.validate()), InputError);
  EXPECT_THROW((RobustAdaptiveOptions{.glare = -0.1}.validate()), InputError);
}

TEST(RobustAdaptive, ShadowsKeepTheirHueWithoutBecomingSaturated) {
  SceneImage image = random_scene(64, 48, 2, 10);
  image.at(5, 5) = {0.02f, 0.015f, 0.011f};  // brownish, below the first percentile
  const Rgb shown = mapped(image).at(5, 5);
  EXPECT_GT(shown.r, shown.g);
  EXPECT_GT(shown.g, shown.b);
  // Encoded as other operators do, the ratio of channels is (0.02/0.011)^(1/2.2) = 1.31.
  EXPECT_LT(shown.r / shown.b, 1.4f);
}

TEST(RobustAdaptive, DrawsColoursTooBrightToShowTowardsGreyInsteadOfClippingThem) {
  SceneImage image = random_scene(64, 48, 2, 10);
  image.at(5, 5) = {1e5f, 1e3f, 1e3f};
  const Rgb shown = mapped(image).at(5, 5);
  EXPECT_EQ(shown.r, 1.0f);
  EXPECT_GT(shown.g, 0.2f);
  EXPECT_NEAR(shown.g, shown.b, 1e-6f);
}

}  // namespace
}  // namespace plenolab
