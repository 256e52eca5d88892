#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/tonemap/reinhard_devlin.h"
#include "core/tonemap/reinhard_global.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

ImageStatistics statistics_of(const SceneImage& image) {
  const ViewStatistics s = measure_view(image);
  return evaluate(s, log_floor(s));
}

SceneImage scaled(const SceneImage& image, float k) {
  SceneImage out = image;
  for (Rgb& c : out.pixels()) c = k * c;
  return out;
}

double largest_difference(const DisplayImage& a, const DisplayImage& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb d = a.pixels()[i] - b.pixels()[i];
    for (const float v : {d.r, d.g, d.b}) largest = std::max(largest, std::abs(static_cast<double>(v)));
  }
  return largest;
}

TEST(ReinhardGlobal, MatchesTheFormulaOnAHandComputedPixel) {
  ImageStatistics s;
  s.log_average = std::log10(2.0);
  const SceneImage image(1, 1, Rgb{10, 10, 10});
  // L_s = 0.18·10/2 = 0.9, L_d = 0.9/1.9
  const ReinhardGlobalOptions plain{.automatic_key = false};
  EXPECT_NEAR(apply(fit(plain, s), image).image.at(0, 0).g, std::pow(0.9 / 1.9, 1 / 2.2), 2e-6);
  const ReinhardGlobalOptions white{.automatic_key = false, .white_point = true, .white = 3};
  EXPECT_NEAR(apply(fit(white, s), image).image.at(0, 0).g, std::pow(0.9 * (1 + 0.9 / 9) / 1.9, 1 / 2.2),
              2e-6);
}

TEST(ReinhardGlobal, WhitePointMapsToOneAndAboveIsCutAndCounted) {
  EXPECT_DOUBLE_EQ(reinhard_curve(3, 3.0), 1);
  EXPECT_DOUBLE_EQ(reinhard_curve(1), 0.5);
  ImageStatistics s;
  const ReinhardGlobalOptions o{.automatic_key = false, .key = 1, .white_point = true, .white = 3};
  SceneImage image(2, 1, Rgb{2.9f, 2.9f, 2.9f});
  image.at(1, 0) = {40, 40, 40};
  const ToneMapped mapped = apply(fit(o, s), image);
  EXPECT_LT(mapped.image.at(0, 0).g, 1);
  EXPECT_EQ(mapped.image.at(1, 0), (Rgb{1, 1, 1}));
  EXPECT_EQ(mapped.counts.clipped_high, 3);
}

TEST(ReinhardGlobal, AutomaticKeyIsTheMiddleGreyForASymmetricDistribution) {
  ImageStatistics s;
  s.log_p1 = -2, s.log_p99 = 2;
  s.log_average = 0;
  EXPECT_NEAR(automatic_key(s), 0.18, 1e-15);
  s.log_average = 2;
  EXPECT_NEAR(automatic_key(s), 0.72, 1e-15);
  s.log_average = -7;  // the floor of many black pixels
  EXPECT_NEAR(automatic_key(s), 0.045, 1e-15);
  s.log_p99 = s.log_p1;
  EXPECT_EQ(automatic_key(s), 0.18);
}

TEST(ReinhardGlobal, DefaultColourEqualsEncodingTheScaledColourByGamma) {
  const SceneImage image = random_scene(20, 10, 2);
  const ReinhardGlobalParameters p = fit(ReinhardGlobalOptions{}, statistics_of(image));
  const DisplayImage out = apply(p, image).image;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb c = image.pixels()[i];
    const double l = static_cast<double>(luminance(c));
    const double scale = reinhard_curve(p.key * l / std::pow(10, p.log_average)) / l;
    EXPECT_NEAR(out.pixels()[i].r, std::min(1.0, std::pow(static_cast<double>(c.r) * scale, 1 / 2.2)), 5e-6);
  }
}

TEST(ReinhardGlobal, DoesNotDependOnTheUnitOfRadiance) {
  const SceneImage image = random_scene(40, 30);
  const SceneImage other = scaled(image, 1024);
  const DisplayImage a = apply(fit(ReinhardGlobalOptions{}, statistics_of(image)), image).image;
  const DisplayImage b = apply(fit(ReinhardGlobalOptions{}, statistics_of(other)), other).image;
  EXPECT_LT(largest_difference(a, b), 1e-5);
}

TEST(ReinhardGlobal, HoldsOverTheWholeRangeOfFloat) {
  for (const float level : {1e-37f, 1.0f, 3e38f}) {
    SceneImage grey(5, 1);
    for (Rgb& c : grey.pixels()) c = {level, level, level};
    const ReinhardGlobalParameters p{.key = 0.18, .log_average = std::log10(static_cast<double>(level))};
    EXPECT_NEAR(apply(p, grey).image.at(2, 0).g, std::pow(0.18f / 1.18f, 1 / 2.2f), 2e-4f) << level;
  }
}

TEST(ReinhardDevlin, MatchesTheFormulaOnAHandComputedPixel) {
  ImageStatistics s;
  s.average_colour = {4, 2, 1};
  s.average_luminance = 2.5;
  s.log_min = -1, s.log_average = 0.5, s.log_max = 2;
  const ReinhardDevlinOptions o{.brightness = -1, .colour_adaptation = 0.25, .light_adaptation = 0.6};
  const ReinhardDevlinParameters p = fit(o, s);
  const double m = 0.3 + 0.7 * std::pow(0.5, 1.4);
  EXPECT_NEAR(p.contrast, m, 1e-15);
  const Rgb c{8, 3, 0.5f};
  const double l = 0.2126 * 8 + 0.7152 * 3 + 0.0722 * 0.5;
  const auto expected = [&](double value, double average) {
    const double local = 0.25 * value + 0.75 * l, global = 0.25 * average + 0.75 * 2.5;
    return value / (value + std::pow(std::exp(1) * (0.6 * local + 0.4 * global), m));
  };
  const Rgb v = respond(p, SceneImage(1, 1, c)).value.at(0, 0);
  EXPECT_NEAR(v.r, expected(8, 4), 1e-6);
  EXPECT_NEAR(v.g, expected(3, 2), 1e-6);
  EXPECT_NEAR(v.b, expected(0.5, 1), 1e-6);
}

TEST(ReinhardDevlin, DefaultsWithoutColourAdaptationMatchTheFormula) {
  const SceneImage image = random_scene(20, 10);
  const ReinhardDevlinParameters p = fit(ReinhardDevlinOptions{}, statistics_of(image));
  const Response response = respond(p, image);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double l = static_cast<double>(luminance(image.pixels()[i]));
    const double g = static_cast<double>(image.pixels()[i].g);
    EXPECT_NEAR(response.value.pixels()[i].g, g / (g + std::pow(l, p.contrast)), 2e-6);
  }
}

TEST(ReinhardDevlin, ContrastRunsFromLowToHighKeyAndHasAValueWithoutRange) {
  ImageStatistics s;
  s.log_min = -2, s.log_max = 2;
  s.log_average = 2;
  EXPECT_NEAR(automatic_contrast(s), 0.3, 1e-15);
  s.log_average = -2;
  EXPECT_NEAR(automatic_contrast(s), 1.0, 1e-15);
  s.log_min = s.log_max = s.log_average;
  EXPECT_NEAR(automatic_contrast(s), 0.3 + 0.7 * std::pow(0.5, 1.4), 1e-15);
}

TEST(ReinhardDevlin, NormalisationWithOwnLimitsFillsTheLumaRange) {
  const SceneImage image =
      grey_image(30, 4, [](int x, int) { return std::pow(10.0f, 0.1f * static_cast<float>(x)); });
  const ReinhardDevlinParameters p = fit(ReinhardDevlinOptions{}, statistics_of(image));
  const LumaLimits limits = measure_limits(p, image);
  const ToneMapped mapped = apply(p, limits, image);
  EXPECT_NEAR(mapped.image.at(0, 0).g, 0, 1e-6);
  EXPECT_NEAR(mapped.image.at(29, 0).g, 1, 1e-6);
  for (int x = 1; x < 30; ++x) EXPECT_GT(mapped.image.at(x, 0).g, mapped.image.at(x - 1, 0).g);
}

TEST(ReinhardDevlin, RespondingAndNormalisingApartEqualsDoingBothAtOnce) {
  const SceneImage image = random_scene(33, 21);
  const ReinhardDevlinParameters p =
      fit(ReinhardDevlinOptions{.colour_adaptation = 0.3}, statistics_of(image));
  const Response response = respond(p, image);
  const LumaLimits limits = response.limits;
  EXPECT_EQ(limits, measure_limits(p, image));
  const ToneMapped apart = normalise(response, limits), together = apply(p, limits, image);
  EXPECT_EQ(apart.image, together.image);
  EXPECT_EQ(apart.counts, together.counts);
  EXPECT_GT(apart.counts.clipped_high + apart.counts.clipped_low, 0);  // channels beyond the luma limits
}

TEST(ReinhardDevlin, EmptyLimitsLeaveTheResponseAsItIs) {
  const SceneImage image(3, 3, Rgb{2, 2, 2});
  const ReinhardDevlinParameters p = fit(ReinhardDevlinOptions{}, statistics_of(image));
  const LumaLimits limits = measure_limits(p, image);
  EXPECT_EQ(limits.min, limits.max);
  EXPECT_EQ(apply(p, limits, image).image.at(1, 1), respond(p, image).value.at(1, 1));
}

TEST(ReinhardDevlin, InterpolatingResultsIsLinearBetweenTheMappings) {
  const SceneImage image = random_scene(12, 9);
  const ReinhardDevlinParameters a = fit(ReinhardDevlinOptions{.contrast = 0.4}, {}),
                                 b = fit(ReinhardDevlinOptions{.contrast = 0.8}, {});
  const Response one = respond(a, image), two = respond(b, image);
  const Response both = respond_interpolated(std::vector{a, b}, std::vector{0.25, 0.75}, image);
  for (std::size_t i = 0; i < image.size(); ++i)
    EXPECT_NEAR(both.value.pixels()[i].r, 0.25f * one.value.pixels()[i].r + 0.75f * two.value.pixels()[i].r,
                1e-6);
  EXPECT_EQ(respond_interpolated(std::vector{a, b}, std::vector{1.0, 0.0}, image).value, one.value);
  EXPECT_THROW(respond_interpolated(std::vector{a, b}, std::vector{1.0}, image), InputError);
  EXPECT_THROW(respond_interpolated(std::vector{a, b}, std::vector{0.9, 0.9}, image), InputError);
}

TEST(ReinhardDevlin, OptionsOutOfRangeAreErrors) {
  EXPECT_THROW((ReinhardDevlinOptions{.brightness = 9}.validate()), InputError);
  EXPECT_THROW((ReinhardDevlinOptions{.colour_adaptation = -0.1}.validate()), InputError);
  EXPECT_THROW((ReinhardDevlinOptions{.light_adaptation = std::nan("")}.validate()), InputError);
  EXPECT_THROW((ReinhardDevlinOptions{.contrast = 1.5}.validate()), InputError);
  EXPECT_THROW((ReinhardDevlinOptions{.exposure = 0}.validate()), InputError);
  EXPECT_THROW(validate(LumaLimits{0.5, 0.5}), InputError);
  EXPECT_THROW((ReinhardGlobalOptions{.key = 0}.validate()), InputError);
  EXPECT_THROW((ReinhardGlobalOptions{.white = -1}.validate()), InputError);
}

}  // namespace
}  // namespace plenolab
