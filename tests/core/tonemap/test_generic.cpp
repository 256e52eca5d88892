// Generic operator and the perceptual quantiser.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/colour.h"
#include "core/tonemap/generic.h"
#include "core/tonemap/pq_operator.h"

namespace plenolab {
namespace {

SceneImage random_scene(int width, int height) {
  SceneImage scene(width, height);
  std::uint64_t n = 0;
  for (Rgb& c : scene.pixels())
    for (float* channel : {&c.r, &c.g, &c.b})
      *channel = static_cast<float>(std::pow(10.0, 2 - 4 * unit_double(random_u64(1, 1, n++))));
  return scene;
}

TEST(Generic, CurveHasTheValuesOfItsFormula) {
  const GenericOptions o{.brightness = 0.5, .low_range = 2, .high_range = 1, .contrast = 0.8};
  EXPECT_DOUBLE_EQ(generic_curve(o, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(generic_curve(o, -1.5), 0);
  EXPECT_NEAR(generic_curve(o, 1.5), 1, 1e-12);
  EXPECT_EQ(generic_curve(o, 9), 1);
  EXPECT_EQ(generic_curve(o, -9), 0);
  // a_l = (0.8·2 − 1)/2 = 0.3: at x − b = −1: −0.4/(1 + 0.3) + 0.5.
  EXPECT_NEAR(generic_curve(o, -0.5), 0.5 - 0.4 / 1.3, 1e-12);
  // a_h = −0.2: at x − b = 0.5: 0.2/(1 − 0.1) + 0.5.
  EXPECT_NEAR(generic_curve(o, 1.0), 0.5 + 0.2 / 0.9, 1e-12);
  // Slope at b is c/2.
  EXPECT_NEAR((generic_curve(o, 0.5 + 1e-6) - generic_curve(o, 0.5 - 1e-6)) / 2e-6, 0.4, 1e-5);
}

TEST(Generic, CurveRisesForAllParametersAtTheEndsOfTheirRanges) {
  for (const double b : {-2.0, 2.0})
    for (const double d_l : {0.001, 2.5})
      for (const double d_h : {0.001, 2.5})
        for (const double c : {0.2, 1.5}) {
          const GenericOptions o{.brightness = b, .low_range = d_l, .high_range = d_h, .contrast = c};
          double before = 0;
          for (int i = -500; i <= 500; ++i) {
            const double y = generic_curve(o, i * 0.01);
            EXPECT_GE(y, before) << i;
            EXPECT_LE(y, 1 + 1e-12);
            before = y;
          }
        }
}

TEST(Generic, MappingFollowsTheCurve) {
  const SceneImage scene = random_scene(40, 30);
  const GenericOptions o{
      .brightness = 0.3, .low_range = 1, .high_range = 0.7, .contrast = 0.9, .colour_exponent = 0};
  const GenericParameters p{o, 0.25};
  const ToneMapped mapped = apply(p, scene, 2);
  for (std::size_t i = 0; i < scene.size(); ++i)
    EXPECT_NEAR(mapped.image.pixels()[i].g, generic_curve(o, std::log10(luminance(scene.pixels()[i])) - 0.25),
                2e-6);
}

TEST(Generic, BandsOverlapInOctavesAndLeaveTheMeanAlone) {
  const GenericOptions fine{.fine = 1}, middle{.middle = 1}, coarse{.coarse = 1};
  EXPECT_EQ(band_log2_gain(fine, 0), 0);
  EXPECT_DOUBLE_EQ(band_log2_gain(fine, 0.25), 1);
  EXPECT_DOUBLE_EQ(band_log2_gain(fine, 0.7), 1);
  EXPECT_DOUBLE_EQ(band_log2_gain(middle, 1 / 16.0), 1);
  EXPECT_NEAR(band_log2_gain(middle, 1 / 8.0), 0.5, 1e-12);
  EXPECT_NEAR(band_log2_gain(middle, 0.25), 0, 1e-12);
  // Neighbours sum to one between their centres.
  for (const double f : {1 / 16.0, 0.08, 0.1, 0.2, 0.25})
    EXPECT_NEAR(band_log2_gain(fine, f) + band_log2_gain(middle, f), 1, 1e-12) << f;
  for (const double f : {1 / 64.0, 0.02, 0.05, 1 / 16.0})
    EXPECT_NEAR(band_log2_gain(coarse, f) + band_log2_gain(middle, f), 1, 1e-12) << f;
}

TEST(Generic, GainsScaleAWaveByTheirFactorAndKeepConstants) {
  // A cosine that the mirrored borders continue: frequency k/(2N).
  const int n = 64, k = 32;  // ¼ cycle/px
  Plane<float> wave(n, 6), flat(7, 5, 0.37f);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < n; ++x)
      wave.at(x, y) = 0.5f + 0.1f * static_cast<float>(std::cos(std::acos(-1.0) * k * (x + 0.5) / n));
  Plane<float> scaled = wave;
  modulate_bands({.fine = -1}, scaled);
  for (std::size_t i = 0; i < wave.size(); ++i)
    EXPECT_NEAR(scaled.pixels()[i] - 0.5f, (wave.pixels()[i] - 0.5f) / 2, 1e-5);
  modulate_bands({.fine = 2, .middle = -2, .coarse = 1}, flat);
  for (const float v : flat.pixels()) EXPECT_NEAR(v, 0.37f, 1e-5);
}

TEST(Generic, GainsOfZeroAreTheIdentityAndOpposedOnesUndoEachOther) {
  Plane<float> plane(33, 21);
  for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = unit_float(random_u64(2, 2, i));
  Plane<float> same = plane;
  modulate_bands({}, same);
  EXPECT_EQ(same, plane);
  // Even sizes: nothing is padded, so nothing is cut off.
  Plane<float> even(32, 20);
  for (std::size_t i = 0; i < even.size(); ++i) even.pixels()[i] = unit_float(random_u64(2, 3, i));
  Plane<float> back = even;
  modulate_bands({.fine = 1, .middle = -1.5, .coarse = 0.5}, back);
  EXPECT_NE(back, even);
  modulate_bands({.fine = -1, .middle = 1.5, .coarse = -0.5}, back);
  for (std::size_t i = 0; i < even.size(); ++i) EXPECT_NEAR(back.pixels()[i], even.pixels()[i], 1e-5);
}

TEST(Generic, BandsOfASmallerImageLieAtLowerFrequencies) {
  const GenericOptions small{.fine = 1, .middle = -0.5, .coarse = 2};
  GenericOptions full = small;
  full.band_scale = 4;
  for (const double f : {0.0, 0.002, 0.01, 0.03, 0.1, 0.5})
    EXPECT_DOUBLE_EQ(band_log2_gain(full, f / 4), band_log2_gain(small, f));
  EXPECT_DOUBLE_EQ(band_log2_gain(full, 0.4), 1) << "everything finer has the gain of the finest band";
  full.band_scale = 0.5;
  EXPECT_THROW(full.validate(), InputError);
}

TEST(Generic, GainsWorkOnImagesOfOnePixelAndOneColumn) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 9), std::pair(9, 1)}) {
    const ToneMapped mapped =
        apply(fit({.fine = 2, .coarse = -2}, ImageStatistics{}), random_scene(width, height), 1);
    for (const Rgb& c : mapped.image.pixels())
      EXPECT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1);
  }
}

TEST(Generic, AConstantImageOfAnyLuminanceIsHalfWay) {
  for (const float level : {1e-37f, 1e-9f, 1.0f, 1e9f, 3e38f}) {
    const SceneImage image(8, 8, Rgb{level, level, level});
    const ViewStatistics measured = measure_view(image, 1);
    const ToneMapped mapped = apply(fit({}, evaluate(measured, log_floor(measured))), image, 1);
    EXPECT_NEAR(luminance(mapped.image.at(3, 3)), 0.5f, 0.01f) << level;
  }
}

TEST(PerceptualQuantiser, HasTheStandardsValuesAndGoesOnAboveThem) {
  EXPECT_NEAR(pq_signal(10000), 1, 1e-12);
  EXPECT_NEAR(pq_signal(100), 0.50808, 5e-6);  // SMPTE ST 2084: 100 cd/m² is code 520 of 1023
  EXPECT_NEAR(pq_signal(1e9), 1.776, 5e-4);
  EXPECT_NEAR(pq_signal(0), pq_encode(0), 1e-15);
  for (const double l : {1e-4, 0.1, 10.0, 4000.0}) EXPECT_NEAR(pq_signal(l), pq_encode(l), 1e-12) << l;
}

TEST(PerceptualQuantiser, MapsThePeakToWhiteAndEveryUnitAlike) {
  SceneImage scene(3, 1);
  scene.at(0, 0) = {100, 100, 100};
  scene.at(1, 0) = {1000, 1000, 1000};
  scene.at(2, 0) = {5000, 5000, 5000};
  const ToneMapped mapped = apply(PqOptions{.peak_cd_m2 = 1000}, scene, 1);
  EXPECT_NEAR(mapped.image.at(0, 0).g, pq_signal(100) / pq_signal(1000), 1e-6);
  EXPECT_EQ(mapped.image.at(1, 0).g, 1);
  EXPECT_EQ(mapped.image.at(2, 0).g, 1);
  SceneImage scaled(3, 1);
  for (int x = 0; x < 3; ++x) scaled.at(x, 0) = scene.at(x, 0) * 0.01f;
  const ToneMapped again = apply(PqOptions{.peak_cd_m2 = 1000, .cd_m2_per_unit = 100}, scaled, 1);
  EXPECT_NEAR(again.image.at(0, 0).g, mapped.image.at(0, 0).g, 1e-6);
  EXPECT_THROW(apply(PqOptions{.peak_cd_m2 = 0}, scene, 1), InputError);
}

}  // namespace
}  // namespace plenolab
