#include "metrics/drim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/base/random.h"
#include "core/image/colour.h"
#include "metrics/vision/perceived_contrast.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

std::map<std::string, double> by_name(const std::vector<Measurement>& rows) {
  std::map<std::string, double> values;
  for (const Measurement& row : rows) values[row.quantity] = row.value;
  return values;
}

/// Numbers of maps with the default viewer.
std::map<std::string, double> compare(const Plane<float>& test, const Plane<float>& reference,
                                      const DrimOptions& options = {}) {
  return by_name(drim_measurements(drim_maps(test, reference, {}, options)));
}

/// Bands of light from 10 to 1000 cd/m² with a clearly visible texture.
Plane<float> textured(int width, int height) {
  Plane<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double light = std::pow(10, 2 + std::sin(0.03 * x) * std::cos(0.02 * y));
      image.at(x, y) = static_cast<float>(light * (1 + 0.25 * std::sin(1.1 * x) * std::sin(0.9 * y)));
    }
  }
  return image;
}

template <class Change>
Plane<float> changed(Plane<float> image, Change change) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) image.at(x, y) = change(image.at(x, y), x, y);
  return image;
}

Plane<float> blurred(const Plane<float>& image, int radius) {
  return changed(image, [&](float, int x, int y) {
    float sum = 0;
    int count = 0;
    for (int v = std::max(0, y - radius); v <= std::min(image.height() - 1, y + radius); ++v)
      for (int u = std::max(0, x - radius); u <= std::min(image.width() - 1, x + radius); ++u, ++count)
        sum += image.at(u, v);
    return sum / static_cast<float>(count);
  });
}

TEST(Drim, AgreesWithItsFormulasComputedElsewhere) {
  // Plain Python over 16×16 pixels: literal transforms, JND by stepping, every formula as printed.
  Plane<float> reference(16, 16), test(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      reference.at(x, y) =
          static_cast<float>(50 * std::pow(10, x / 16.0) * (1 + 0.5 * std::sin(0.9 * x) * std::cos(0.7 * y)));
      test.at(x, y) = static_cast<float>(80 * std::pow(10, x / 32.0) *
                                         (1 + 0.25 * std::sin(0.9 * x + 0.8) * std::cos(0.7 * y)));
    }
  }
  const auto contrast = vision::perceived_contrast(reference, {}, 1);
  EXPECT_NEAR(contrast.at(3, 5), -21.537701, 0.01);
  EXPECT_NEAR(contrast.at(12, 9), -31.113622, 0.01);
  EXPECT_NEAR(vision::perceived_contrast(test, {}, 1).at(3, 5), 0.790843, 0.01);
  const auto rows = compare(test, reference);
  EXPECT_NEAR(rows.at("drim_mean_loss"), 25.06375, 0.02);
  EXPECT_NEAR(rows.at("drim_mean_amplification"), 4.13121, 0.02);
  EXPECT_NEAR(rows.at("drim_mean_reversal"), 32.94468, 0.02);
}

TEST(Drim, OfIdenticalImagesIsExactlyNone) {
  for (const auto& [quantity, value] : compare(textured(96, 70), textured(96, 70)))
    EXPECT_EQ(value, 0) << quantity;
}

TEST(Drim, FindsLossWhereABlurTookTheTexture) {
  const Plane<float> truth = textured(128, 96);
  const auto rows = compare(blurred(truth, 5), truth);
  EXPECT_GT(rows.at("drim_share_loss"), 0.5);
  EXPECT_LT(rows.at("drim_share_amplification"), 0.02);
  EXPECT_LT(rows.at("drim_share_reversal"), 0.05);
}

TEST(Drim, FindsAmplificationWhereTextureWasAdded) {
  const Plane<float> textured_image = textured(128, 96), smooth = blurred(textured_image, 5);
  const auto rows = compare(textured_image, smooth);
  EXPECT_GT(rows.at("drim_share_amplification"), 0.5);
  EXPECT_LT(rows.at("drim_share_loss"), 0.02);
}

TEST(Drim, ExchangesLossAndAmplificationWithTheImages) {
  const Plane<float> a = textured(80, 64), b = blurred(a, 3);
  const auto forward = compare(a, b), backward = compare(b, a);
  EXPECT_EQ(forward.at("drim_mean_loss"), backward.at("drim_mean_amplification"));
  EXPECT_EQ(forward.at("drim_mean_amplification"), backward.at("drim_mean_loss"));
  EXPECT_EQ(forward.at("drim_mean_reversal"), backward.at("drim_mean_reversal"));
}

TEST(Drim, FindsReversalWhereContrastIsInverted) {
  const Plane<float> truth = textured(128, 96);
  const Plane<float> inverted = changed(truth, [](float v, int, int) { return 1e4f / v; });
  const auto rows = compare(inverted, truth);
  EXPECT_GT(rows.at("drim_share_reversal"), 0.5);
  EXPECT_GT(rows.at("drim_mean_reversal"), 3 * rows.at("drim_mean_loss"));
}

TEST(Drim, HardlyChangesWhenPhotopicLuminanceIsScaledByTen) {
  const Plane<float> truth = textured(128, 96);
  const Plane<float> brighter = changed(truth, [](float v, int, int) { return 10 * v; });
  const auto rows = compare(brighter, truth);
  EXPECT_LT(rows.at("drim_share_any"), 0.01);
  EXPECT_LT(rows.at("drim_mean_total"), 5);
}

TEST(Drim, CallsContrastBelowTheThresholdInvisibleOnBothSides) {
  const Plane<float> even(96, 96, 100);
  const Plane<float> faint =
      changed(even, [](float v, int x, int) { return v * (1 + 0.001f * std::sin(static_cast<float>(x))); });
  EXPECT_LT(compare(faint, even).at("drim_mean_total"), 0.01);
}

TEST(Drim, OfASmallSpotStaysWhereTheSpotIs) {
  const Plane<float> truth(256, 128, 100);
  const Plane<float> spot =
      changed(truth, [](float v, int x, int y) { return std::hypot(x - 60, y - 64) < 4 ? 3 * v : v; });
  const DrimMaps maps = drim_maps(spot, truth, {});
  EXPECT_GT(maps.amplification.at(60, 64), 0.9f);
  EXPECT_LT(maps.amplification.at(240, 64), 0.05f);
  EXPECT_LT(maps.loss.at(60, 64), 0.05f);
}

TEST(Drim, DistortionGrowsWithTheContrastThatIsAdded) {
  const Plane<float> even(96, 96, 100);
  double before = 0;
  for (const float contrast : {0.005f, 0.02f, 0.05f, 0.2f}) {
    const Plane<float> test = changed(even, [&](float v, int x, int y) {
      return v * (1 + contrast * std::sin(0.9f * static_cast<float>(x) + 0.3f * static_cast<float>(y)));
    });
    const double now = compare(test, even).at("drim_mean_amplification");
    EXPECT_GE(now, before) << contrast;
    before = now;
  }
  EXPECT_GT(before, 50);
}

TEST(Drim, AWiderMarginFindsLess) {
  const Plane<float> truth = textured(96, 70), test = blurred(truth, 2);
  DrimOptions none, wide;
  none.margin_log10 = 0;
  wide.margin_log10 = 1;
  EXPECT_GT(compare(test, truth, none).at("drim_mean_loss"), compare(test, truth, wide).at("drim_mean_loss"));
}

TEST(Drim, TakesDisplayImagesThroughTheDisplay) {
  // A picture on a display against the light that this display emits.
  const ComparisonConditions conditions;
  DisplayImage picture(64, 48);
  RandomStream random(1, 2, 3);
  for (Rgb& c : picture.pixels()) c = Rgb{1, 1, 1} * random.next_float();
  const Plane<float> light = displayed_luminance(picture, conditions.viewing);
  SceneImage scene(64, 48);
  for (std::size_t i = 0; i < scene.size(); ++i) scene.pixels()[i] = Rgb{1, 1, 1} * light.pixels()[i];
  EXPECT_LT(by_name(drim(picture, scene, conditions)).at("drim_share_any"), 1e-3);
}

TEST(Drim, IsFiniteOnEveryLuminance) {
  Plane<float> zeros(20, 15), ramp(20, 15), suns(20, 15);
  for (std::size_t i = 0; i < ramp.size(); ++i)
    ramp.pixels()[i] = std::pow(10.0f, -9 + 18 * static_cast<float>(i) / static_cast<float>(ramp.size()));
  suns.at(3, 3) = 1e10f;
  for (const Plane<float>* test : {&zeros, &ramp, &suns}) {
    for (const Plane<float>* reference : {&zeros, &ramp, &suns}) {
      for (const auto& [quantity, value] : compare(*test, *reference)) {
        EXPECT_TRUE(std::isfinite(value)) << quantity;
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 300);
      }
    }
  }
}

TEST(Drim, RunsWithAnyLayoutOfTheCortex) {
  const Plane<float> truth = textured(64, 48), test = blurred(truth, 3);
  for (const auto& [bands, orientations] : {std::pair{1, 1}, {2, 3}, {7, 4}}) {
    DrimOptions options;
    options.bands = bands;
    options.orientations = orientations;
    EXPECT_GT(compare(test, truth, options).at("drim_mean_loss"), 1) << bands << " " << orientations;
  }
}

TEST(Drim, SaysWhatIsWrongWithOptionsAndSizes) {
  const Plane<float> image(8, 8, 1);
  const auto message = [&](auto change) {
    DrimOptions options;
    change(options);
    return message_of([&] { drim_maps(image, image, {}, options); });
  };
  EXPECT_NE(message([](auto& o) { o.bands = 0; }).find("bands is 0"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.orientations = 99; }).find("orientations is 99"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.margin_log10 = -1; }).find("margin_log10"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.threshold_jnd = 0; }).find("threshold_jnd"), std::string::npos);
  const std::string sizes = message_of([&] { drim_maps(image, Plane<float>(9, 8, 1), {}); });
  EXPECT_NE(sizes.find("8×8 with 9×8"), std::string::npos) << sizes;
}

TEST(DrimMeasurements, CountSharesFromOneHalfAndSumTheMeans) {
  DrimMaps maps{Plane<float>(2, 2), Plane<float>(2, 2), Plane<float>(2, 2)};
  maps.loss.at(0, 0) = 0.5f;
  maps.amplification.at(0, 0) = 0.9f;
  maps.reversal.at(1, 1) = 0.4f;
  const auto rows = by_name(drim_measurements(maps));
  EXPECT_EQ(rows.at("drim_share_any"), 0.25);
  EXPECT_EQ(rows.at("drim_share_loss"), 0.25);
  EXPECT_EQ(rows.at("drim_share_reversal"), 0);
  EXPECT_NEAR(rows.at("drim_mean_amplification"), 22.5, 1e-5);
  EXPECT_NEAR(rows.at("drim_mean_total"), 45, 1e-5);
}

TEST(DrimFalseColour, ShowsTheMostProbableKind) {
  DrimMaps maps{Plane<float>(4, 1), Plane<float>(4, 1), Plane<float>(4, 1)};
  maps.loss.at(1, 0) = 1;
  maps.amplification.at(2, 0) = 0.9f;
  maps.loss.at(2, 0) = 0.3f;
  maps.reversal.at(3, 0) = 1;
  const DisplayImage picture = drim_false_colour(maps, DisplayImage(4, 1, {0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(picture.at(0, 0).r, picture.at(0, 0).g);
  EXPECT_GT(picture.at(1, 0).g, 2 * std::max(picture.at(1, 0).r, picture.at(1, 0).b));
  EXPECT_GT(picture.at(2, 0).b, 2 * std::max(picture.at(2, 0).r, picture.at(2, 0).g));
  EXPECT_GT(picture.at(3, 0).r, 2 * std::max(picture.at(3, 0).g, picture.at(3, 0).b));
}

}  // namespace
}  // namespace plenolab
