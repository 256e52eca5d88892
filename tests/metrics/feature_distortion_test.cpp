#include "metrics/feature_distortion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "core/image/colour.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

/// Four decades, with texture everywhere.
Plane<float> scene(int width, int height) {
  Plane<float> luminance(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      luminance.at(x, y) = static_cast<float>(std::pow(10, 4.0 * x / (width - 1) - 2) *
                                              (1 + 0.4 * std::sin(1.3 * x) * std::sin(1.1 * y)));
  return luminance;
}

/// A picture whose luma is `curve` of log10 luminance.
template <class Curve>
DisplayImage mapped(const Plane<float>& luminance, Curve curve) {
  DisplayImage image(luminance.width(), luminance.height());
  for (std::size_t i = 0; i < image.size(); ++i)
    image.pixels()[i] = Rgb{1, 1, 1} * static_cast<float>(std::clamp<double>(
                                           curve(std::log10(luminance.pixels()[i])), 0.0, 1.0));
  return image;
}

double logarithmic(double log10) {
  return 0.5 + 0.2 * log10;
}

TEST(FeatureReference, PlacesExposuresTwoStopsApartFromDarkToBright) {
  const FeatureReference reference = feature_reference(scene(200, 50), {});
  ASSERT_GE(reference.centres.size(), 6u);
  for (std::size_t i = 1; i < reference.centres.size(); ++i)
    EXPECT_NEAR(reference.centres[i] / reference.centres[i - 1], 4, 1e-9);
  EXPECT_LE(reference.centres.front(), 0.02);
  EXPECT_GE(reference.centres.back(), 50);
}

TEST(FeatureReference, OfOneLuminanceIsOnePhotographAroundItsMiddle) {
  const FeatureReference reference = feature_reference(Plane<float>(20, 20, 7), {});
  ASSERT_EQ(reference.centres.size(), 1u);
  EXPECT_NEAR(reference.centres[0], 7, 1e-5);
  EXPECT_NEAR(reference.brightness, std::pow(0.5, 1 / 2.2), 1e-5);
}

TEST(FeatureReference, DoesNotDependOnTheUnitOfLuminance) {
  Plane<float> brighter = scene(80, 40);
  for (float& v : brighter.pixels()) v *= 1024;
  const FeatureReference a = feature_reference(scene(80, 40), {}), b = feature_reference(brighter, {});
  EXPECT_NEAR(a.brightness, b.brightness, 1e-6);
  EXPECT_EQ(a.dark, b.dark);
}

TEST(FeatureDistortion, PrefersAPictureThatKeepsDetailInTheDarkAndInTheBright) {
  const Plane<float> luminance = scene(200, 60);
  const FeatureReference reference = feature_reference(luminance, {});
  const auto of = [&](auto curve) { return feature_distortion(mapped(luminance, curve), reference, {}); };
  const FeatureDistortion good = of(logarithmic);
  const FeatureDistortion clipped = of([](double log10) { return 0.5 + 1.5 * log10; });
  const FeatureDistortion black = of([](double) { return 0.0; });
  EXPECT_LT(good.detail, clipped.detail);
  EXPECT_LT(good.total, clipped.total);
  EXPECT_EQ(black.detail, 1);
  EXPECT_LE(clipped.detail, black.detail);
}

TEST(FeatureDistortion, OfBrightnessIsTheDifferenceOfMeanLuma) {
  const FeatureReference reference = feature_reference(Plane<float>(20, 20, 7), {});
  const FeatureDistortion d = feature_distortion(DisplayImage(20, 20, {0.25f, 0.25f, 0.25f}), reference, {});
  EXPECT_NEAR(d.brightness, std::pow(0.5, 1 / 2.2) - 0.25, 1e-5);
  EXPECT_EQ(d.saliency, 0);
  EXPECT_EQ(d.detail, 0) << "there was no detail to lose";
}

TEST(FeatureDistortion, OfSaliencyGrowsWhenAttentionIsDrawnElsewhere) {
  Plane<float> luminance(96, 64, 1);
  luminance.at(20, 30) = 50;
  const FeatureReference reference = feature_reference(luminance, {});
  DisplayImage same(96, 64, {0.4f, 0.4f, 0.4f}), elsewhere = same;
  same.at(20, 30) = {1, 1, 1};
  elsewhere.at(75, 30) = {1, 1, 1};
  const double here = feature_distortion(same, reference, {}).saliency;
  const double there = feature_distortion(elsewhere, reference, {}).saliency;
  EXPECT_LT(here, 0.2);
  EXPECT_GT(there, 2 * here);
}

TEST(FeatureDistortion, WeighsAsTheOptionsSay) {
  const Plane<float> luminance = scene(60, 40);
  const FeatureReference reference = feature_reference(luminance, {});
  const DisplayImage picture = mapped(luminance, logarithmic);
  FeatureOptions options;
  options.brightness_weight = options.saliency_weight = 0;
  const FeatureDistortion d = feature_distortion(picture, reference, options);
  EXPECT_EQ(d.total, d.detail);
}

TEST(FeatureReference, TakesPhotographsByTheOperatorGiven) {
  FeatureOptions options;
  int calls = 0;
  options.photograph = [&](const Plane<float>& window, double centre, const Mask*) {
    ++calls;
    for (const float v : window.pixels()) {
      EXPECT_GE(v, 0.999 * centre / 8);
      EXPECT_LE(v, 1.001 * centre * 8);
    }
    return Plane<float>(window.width(), window.height(), 0.25f);
  };
  const FeatureReference reference = feature_reference(scene(60, 40), options, nullptr, 1);
  EXPECT_EQ(calls, static_cast<int>(reference.centres.size()));
  EXPECT_NEAR(reference.brightness, 0.25, 1e-6);
}

TEST(FeatureReference, OfContentAdaptivePhotographsShowsMoreDetailWherePixelsAre) {
  // Faint texture about two levels, far apart; the adapted curve is steeper there.
  Plane<float> luminance(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      luminance.at(x, y) = static_cast<float>((x < 32 ? 1 : 40) * (1 + 0.03 * std::sin(1.1 * x + 0.7 * y)));
  FeatureOptions adaptive;
  adaptive.photograph = content_adaptive_photograph;
  const auto energy = [&](const FeatureOptions& options) {
    const FeatureReference reference = feature_reference(luminance, options);
    return reference.gradient_energy.at(10, 10) + reference.gradient_energy.at(50, 50);
  };
  EXPECT_GT(energy(adaptive), energy({}));
}

TEST(FeatureReference, DoesNotDependOnHowManyPixelsAreMasked) {
  for (const Photograph& photograph :
       {Photograph(photographic_photograph), Photograph(content_adaptive_photograph)}) {
    FeatureOptions options;
    options.photograph = photograph;
    std::vector<double> brightness;
    for (const int masked : {8, 64, 400}) {
      const Plane<float> valid_part = scene(48, 48);
      Plane<float> luminance(48 + masked, 48, 3.0f);
      Mask valid(48 + masked, 48);
      for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) luminance.at(x, y) = valid_part.at(x, y), valid.at(x, y) = 1;
      brightness.push_back(feature_reference(luminance, options, &valid).brightness);
    }
    EXPECT_NEAR(brightness[1], brightness[0], 1e-9);
    EXPECT_NEAR(brightness[2], brightness[0], 1e-9);
  }
}

TEST(FeaturePhotographic, DoesNotDependOnTheUnitOfTheScene) {
  const Plane<float> luminance = scene(80, 40);
  const DisplayImage picture = mapped(luminance, logarithmic);
  const auto total = [&](float unit) {
    SceneImage image(80, 40);
    for (std::size_t i = 0; i < image.size(); ++i)
      image.pixels()[i] = Rgb{1, 1, 1} * (unit * luminance.pixels()[i]);
    return feature_photographic(picture, image, {}).front().value;
  };
  for (const float unit : {1e-9f, 1e9f, 1e30f}) EXPECT_NEAR(total(unit), total(1), 1e-5) << unit;
}

TEST(Saliency, IsADistribution) {
  for (const auto& [width, height] : {std::pair{50, 40}, {1, 1}, {1, 30}}) {
    const Plane<float> map = saliency_of(scene(std::max(width, 2), height));
    EXPECT_NEAR(std::accumulate(map.pixels().begin(), map.pixels().end(), 0.0), 1, 1e-4);
    const Plane<float> even = saliency_of(Plane<float>(width, height, 0.5f));
    EXPECT_NEAR(even.at(0, 0), 1.0 / (width * height), 1e-6);
  }
}

TEST(FeatureOptions, SayWhatIsOutOfRange) {
  const auto message = [](auto change) {
    FeatureOptions options;
    change(options);
    return message_of([&] { feature_reference(Plane<float>(4, 4, 1), options); });
  };
  EXPECT_NE(message([](auto& o) { o.step_ev = 0; }).find("step_ev is 0"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.half_window_ev = NAN; }).find("half_window_ev"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.detail_weight = -1; }).find("weights"), std::string::npos);
}

}  // namespace
}  // namespace plenolab
