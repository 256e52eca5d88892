#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/bilateral.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

constexpr int kWidth = 512, kHeight = 33, kEdge = 256;
constexpr double kStep = 0.2;

/// A foreground (left, brighter by a log step) before a background.
SceneImage step_scene() {
  return grey_image(kWidth, kHeight,
                    [](int x, int) { return x < kEdge ? static_cast<float>(std::pow(10, kStep)) : 1.0f; });
}

DisparityMap step_disparity() {
  DisparityMap d(kWidth, kHeight, 2.0f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kEdge; ++x) d.at(x, y) = 12;
  return d;
}

BilateralToneOptions exact(bool enhanced) {
  return {.enhanced = enhanced, .exact = true, .compression = 0.4, .brightness = 0};
}

/// Row of log10 L_target.
Plane<float> target(BilateralToneOptions options) {
  const DisparityMap disparity = step_disparity();
  const BilateralLayers layers = bilateral_layers(options, step_scene(), &disparity, 1.0);
  return target_log_luminance(fit(options, range_of(measure_base(layers), 0), 1.0), layers);
}

double edge_contrast(const Plane<float>& log) {
  const int y = kHeight / 2;
  return static_cast<double>(log.at(kEdge - 1, y)) - static_cast<double>(log.at(kEdge, y));
}

/// How much the level beside the edge differs from that far from it.
double profile(const Plane<float>& log, int beside, int far) {
  return static_cast<double>(log.at(beside, kHeight / 2)) - static_cast<double>(log.at(far, kHeight / 2));
}

TEST(BilateralOperator, EdgeContrastsOfThePublishedStepAreFound) {
  BilateralToneOptions without = exact(true);
  without.foreground_scale = 0;
  EXPECT_NEAR(edge_contrast(target(exact(false))), 0.188, 0.001);
  EXPECT_NEAR(edge_contrast(target(without)), 0.080, 0.001);
  EXPECT_NEAR(edge_contrast(target(exact(true))), 0.135, 0.0015);
}

TEST(BilateralOperator, EnhancedHasHalfACornsweetProfileOnTheForegroundAndNoneOnTheBackground) {
  const Plane<float> naive = target(exact(false)), enhanced = target(exact(true));
  EXPECT_GT(profile(naive, kEdge - 1, 5), 0.04);
  EXPECT_LT(profile(naive, kEdge, kWidth - 5), -0.04);
  EXPECT_NEAR(profile(enhanced, kEdge, kWidth - 5), 0, 1e-5);
  EXPECT_NEAR(profile(enhanced, kEdge - 1, 5), profile(naive, kEdge - 1, 5), 1e-6);
}

TEST(BilateralOperator, EnhancedEqualsNaiveOnTheForegroundWithTheDefaultScale) {
  const Plane<float> naive = target(exact(false)), enhanced = target(exact(true));
  for (int x = 0; x < kEdge; ++x) EXPECT_NEAR(enhanced.at(x, 16), naive.at(x, 16), 1e-6f) << x;
}

TEST(BilateralOperator, EnhancedEqualsNaiveBitByBitWithoutDepthEdges) {
  const SceneImage image = random_scene(48, 32);
  const DisparityMap flat(48, 32, 7.0f);
  for (const bool slow : {false, true}) {
    BilateralToneOptions o{.enhanced = false, .exact = slow};
    const BilateralLayers naive = bilateral_layers(o, image, nullptr, 1e-3);
    o.enhanced = true;
    const BilateralLayers enhanced = bilateral_layers(o, image, &flat, 1e-3);
    EXPECT_TRUE(enhanced.foreground.empty());
    EXPECT_EQ(naive.base, enhanced.base);
    const BilateralToneParameters p = fit(o, range_of(measure_base(naive), o.outliers), 1e-3);
    EXPECT_EQ(
        apply(p, image, &flat).image,
        apply(
            BilateralToneParameters{
                {.exact = slow}, 1e-3, p.compression, p.brightness, p.foreground_scale, p.colour_exponent},
            image, nullptr)
            .image);
  }
}

TEST(BilateralOperator, CompressionOneIsTheIdentityWithAndWithoutDepthEdges) {
  for (const bool enhanced : {false, true}) {
    BilateralToneOptions o = exact(enhanced);
    o.compression = 1;
    const Plane<float> log = target(o);
    EXPECT_NEAR(log.at(3, 3), kStep, 1e-6);
    EXPECT_NEAR(log.at(kWidth - 3, 3), 0, 1e-6);
    EXPECT_NEAR(log.at(kEdge, 3), 0, 1e-6);
  }
}

TEST(BilateralOperator, AutomaticSettingsCompressTheBasesToAContrastOfFiveBelowWhite) {
  const BilateralToneParameters p = fit({}, BaseRange{-2, 3}, 1e-2);
  EXPECT_NEAR(p.compression, std::log10(5) / 5, 1e-15);
  EXPECT_NEAR(p.brightness, 3 * p.compression, 1e-15);
  EXPECT_NEAR(p.foreground_scale, 1 - p.compression, 1e-15);
  const BilateralToneParameters narrow = fit({}, BaseRange{1, 1.5}, 1e-2);
  EXPECT_EQ(narrow.compression, 1);
  EXPECT_EQ(fit({}, BaseRange{1, 1}, 1e-2).compression, 1);
}

TEST(BilateralOperator, TheContrastOfBasesCanBeChosen) {
  EXPECT_NEAR(fit({.contrast = 50}, BaseRange{-2, 3}, 1e-2).compression, std::log10(50) / 5, 1e-15);
  EXPECT_EQ(fit({.contrast = 50, .compression = 0.3}, BaseRange{-2, 3}, 1e-2).compression, 0.3);
}

TEST(BilateralOperator, ColoursLoseSaturationWithCompressionAndKeepLinearRatiosWithoutIt) {
  EXPECT_NEAR(colour_exponent_of(1), 1 / 2.2, 1e-12);
  double previous = 0;
  for (const double compression : {0.05, 0.1, 0.3, 0.6, 0.9, 1.0}) {
    EXPECT_GT(colour_exponent_of(compression), previous);
    previous = colour_exponent_of(compression);
  }
  EXPECT_EQ(fit({.colour_exponent = 0.7}, BaseRange{-2, 3}, 1e-2).colour_exponent, 0.7);
  EXPECT_EQ(fit({}, BaseRange{-2, 3}, 1e-2).colour_exponent, colour_exponent_of(std::log10(5) / 5));
}

TEST(BilateralOperator, ADarkSaturatedColourBesideALightIsNotCutWithAutomaticSettings) {
  const SceneImage image = image_of(64, 8, [](int x, int) {
    return x < 32 ? Rgb{1e-3f, 1e-4f, 1e-4f} : Rgb{100, 100, 100};
  });
  const auto clipped = [&](std::optional<double> exponent) {
    const BilateralToneOptions o{.exact = true, .colour_exponent = exponent};
    const BaseHistogram bases = measure_base(bilateral_layers(o, image, nullptr, 1e-4));
    return apply(fit(o, range_of(bases, o.outliers), 1e-4), image, nullptr).counts.clipped_high;
  };
  EXPECT_EQ(clipped(std::nullopt), 0);
  EXPECT_GT(clipped(0.7), 0);
}

TEST(BilateralOperator, LayersAddUpToTheLogLuminance) {
  const SceneImage image = random_scene(40, 24);
  const BilateralLayers layers = bilateral_layers({}, image, nullptr, 1e-3);
  const Plane<float> detail = layers.detail();
  for (std::size_t i = 0; i < image.size(); ++i)
    EXPECT_NEAR(layers.base.pixels()[i] + detail.pixels()[i], layers.log_luminance.pixels()[i], 1e-6f);
}

TEST(BilateralOperator, DoesNotDependOnTheUnitWithAutomaticSettings) {
  const SceneImage image = random_scene(40, 24);
  SceneImage brighter = image;
  for (Rgb& c : brighter.pixels()) c = 4096.0f * c;
  const auto map = [](const SceneImage& view, double floor) {
    const BilateralToneOptions o{.exact = true};
    const BaseHistogram bases = measure_base(bilateral_layers(o, view, nullptr, floor));
    return apply(fit(o, range_of(bases, o.outliers), floor), view, nullptr).image;
  };
  const DisplayImage a = map(image, 1e-3), b = map(brighter, 4.096);
  // A bin of the histogram of bases is 0.001 log10 units wide, and display values are at most 1.
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.pixels()[i].g, b.pixels()[i].g, 0.003f);
}

BilateralLayers layers_with_base(const std::vector<float>& base) {
  BilateralLayers layers;
  layers.base = Plane<float>(static_cast<int>(base.size()), 1);
  std::copy(base.begin(), base.end(), layers.base.pixels().begin());
  return layers;
}

TEST(BilateralOperator, AFewOutliersDoNotMoveTheRangeOfBasesAndExtremesCanBeAskedFor) {
  std::vector<float> values;
  for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>(i) * 0.002f);
  const BaseRange clean = range_of(measure_base(layers_with_base(values)), 0.01);
  EXPECT_NEAR(clean.min, 0.02, 0.002);
  EXPECT_NEAR(clean.max, 1.978, 0.002);
  values[0] = -40;
  values[999] = 38;
  const BaseHistogram bases = measure_base(layers_with_base(values));
  EXPECT_EQ(range_of(bases, 0.01), clean);
  EXPECT_EQ(range_of(bases, 0), (BaseRange{-40, 38}));
}

TEST(BilateralOperator, TheRangeOfMergedBasesIsThatOfAllValuesTogether) {
  const BaseHistogram one = measure_base(layers_with_base({0, 0.5f, 1})),
                      two = measure_base(layers_with_base({1, 1, 4}));
  const BaseHistogram all = measure_base(layers_with_base({0, 0.5f, 1, 1, 1, 4}));
  for (const double outliers : {0.0, 0.1, 0.17, 0.2})
    EXPECT_EQ(range_of(merge(one, two), outliers), range_of(all, outliers)) << outliers;
  const BaseHistogram constant = measure_base(layers_with_base({0.3f}));
  EXPECT_EQ(range_of(constant, 0.01).min, range_of(constant, 0.01).max);
}

TEST(BilateralOperator, MissingOrWrongDisparityAndOptionsAreErrors) {
  const SceneImage image = random_scene(8, 8);
  const DisparityMap other(7, 8, 0.0f), bad(8, 8, NAN);
  const BilateralToneOptions enhanced{.enhanced = true};
  EXPECT_THROW(bilateral_layers(enhanced, image, nullptr, 1), InputError);
  EXPECT_THROW(bilateral_layers(enhanced, image, &other, 1), InputError);
  EXPECT_THROW(bilateral_layers(enhanced, image, &bad, 1), InputError);
  EXPECT_THROW(bilateral_layers({}, image, nullptr, 0), InputError);
  EXPECT_THROW((BilateralToneOptions{.sigma_s_share = 0}.validate()), InputError);
  EXPECT_THROW((BilateralToneOptions{.sigma_log10 = -1}.validate()), InputError);
  EXPECT_THROW((BilateralToneOptions{.compression = 1.5}.validate()), InputError);
  EXPECT_THROW((BilateralToneOptions{.contrast = 1}.validate()), InputError);
  EXPECT_THROW((BilateralToneOptions{.colour_exponent = 1.5}.validate()), InputError);
  for (const double outliers : {-0.1, 0.3, std::nan("")})
    EXPECT_THROW((BilateralToneOptions{.outliers = outliers}.validate()), InputError) << outliers;
  EXPECT_THROW((BilateralToneOptions{.foreground_scale = -1}.validate()), InputError);
}

/// The same with and without leaving stages out.
void expect_equal_pruned(BilateralToneParameters p, const SceneImage& image, const DisparityMap& disparity) {
  p.options.prune = true;
  const ToneMapped pruned = apply(p, image, &disparity);
  p.options.prune = false;
  const ToneMapped full = apply(p, image, &disparity);
  EXPECT_EQ(pruned.image, full.image);
  EXPECT_EQ(pruned.counts, full.counts);
}

TEST(BilateralOperator, LeavingStagesOutChangesNoBit) {
  const SceneImage image = random_scene(48, 32);
  const DisparityMap flat(48, 32, 7.0f);
  DisparityMap edges = flat;
  for (int y = 0; y < 32; ++y) edges.at(20, y) = 3;
  for (const bool slow : {false, true})
    for (const bool enhanced : {false, true})
      for (const double compression : {0.4, 1.0})
        for (const DisparityMap* disparity : std::array<const DisparityMap*, 2>{&flat, &edges}) {
          const BilateralToneOptions o{.enhanced = enhanced, .exact = slow, .compression = compression};
          expect_equal_pruned(fit(o, BaseRange{-1, 3}, 1e-3), image, *disparity);
        }
}

TEST(BilateralOperator, WithoutCompressionTheTargetIsTheLuminanceThatTheLayersAddUpTo) {
  const SceneImage image = random_scene(40, 24);
  const BilateralToneOptions o{.compression = 1, .brightness = 0.5};
  const BilateralLayers layers = bilateral_layers(o, image, nullptr, 1e-3);
  const Plane<float> log = target_log_luminance(fit(o, BaseRange{0, 1}, 1e-3), layers),
                     detail = layers.detail();
  for (std::size_t i = 0; i < log.size(); ++i)
    EXPECT_NEAR(log.pixels()[i], layers.base.pixels()[i] + detail.pixels()[i] - 0.5f, 1e-6f);
}

TEST(BilateralOperator, FitsFindTheSameBasesWithoutTheForegroundLayer) {
  const SceneImage image = random_scene(48, 32);
  DisparityMap edges(48, 32, 7.0f);
  for (int y = 0; y < 32; ++y) edges.at(20, y) = 3;
  const BilateralLayers all = bilateral_layers({.enhanced = true}, image, &edges, 1e-3);
  const BilateralLayers base = bilateral_layers({.enhanced = true}, image, &edges, 1e-3, 0, false);
  EXPECT_FALSE(all.foreground.empty());
  EXPECT_TRUE(base.foreground.empty());
  EXPECT_EQ(all.base, base.base);
}

TEST(BilateralOperator, LeavingTheBaseOutStillAsksForADisparityMap) {
  const BilateralToneOptions o{.enhanced = true, .compression = 1};
  EXPECT_THROW(apply(fit(o, BaseRange{0, 1}, 1), random_scene(8, 8), nullptr), InputError);
}

}  // namespace
}  // namespace plenolab
