// Analytic and published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/colour.h"
#include "metrics/difference.h"
#include "metrics/error_map.h"
#include "metrics/psnr.h"
#include "metrics/ssim.h"

namespace plenolab {
namespace {

DisplayImage grey(int width, int height, float value) {
  return {width, height, {value, value, value}};
}

std::map<std::string, double> by_name(const std::vector<Measurement>& rows) {
  std::map<std::string, double> values;
  for (const Measurement& row : rows) values[row.quantity] = row.value;
  return values;
}

TEST(PsnrGamma, OfAConstantOffsetIsMinusTwentyLogOfTheOffset) {
  const auto rows = psnr_gamma(grey(9, 7, 0.35f), grey(9, 7, 0.25f), {});
  EXPECT_NEAR(rows.front().value, 20.0, 1e-5);
}

TEST(PsnrGamma, EncodesAtTheExposureOfTheConditions) {
  const SceneImage reference(4, 4, {100, 100, 100}), test(4, 4, {50, 50, 50});
  ComparisonConditions conditions;
  conditions.exposure = 0.01f;
  const double expected = -20 * std::log10(1 - std::pow(0.5, 1 / 2.2));
  const auto rows = by_name(psnr_gamma(test, reference, conditions));
  EXPECT_NEAR(rows.at("psnr_gamma_db"), expected, 1e-4);
  EXPECT_EQ(rows.at("gamma_clipped_share"), 0);
}

TEST(PsnrGamma, SaysWhichShareOfTheReferenceIsClipped) {
  SceneImage reference(4, 1, {0.5f, 0.5f, 0.5f});
  reference.at(2, 0).g = 1.5f;
  EXPECT_EQ(by_name(psnr_gamma(reference, reference, {})).at("gamma_clipped_share"), 0.25);
}

TEST(PsnrLinear, UsesTheLargestReferenceValueAsPeak) {
  SceneImage reference(10, 10, {1, 1, 1});
  reference.at(3, 3).g = 1000;
  SceneImage test = reference;
  for (Rgb& c : test.pixels()) c += {2, 2, 2};
  const auto rows = by_name(psnr_linear(test, reference, {}));
  EXPECT_EQ(rows.at("psnr_linear_peak"), 1000);
  EXPECT_NEAR(rows.at("psnr_linear_db"), 20 * std::log10(1000.0 / 2), 1e-5);
}

TEST(PsnrLinear, OfABlackReferenceIsMinusInfinity) {
  const SceneImage black(3, 3), lit(3, 3, {1, 0, 0});
  EXPECT_EQ(psnr_linear(lit, black, {}).front().value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(psnr_linear(black, black, {}).front().value, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(psnr_linear(black, black, {}).front().infinite());
}

TEST(PsnrPq, ComparesPublishedCodeValues) {
  // ST 2084: 100 cd/m² ↔ 0.508078, 1000 cd/m² ↔ 0.751827.
  const SceneImage reference(5, 5, {1, 1, 1}), test(5, 5, {10, 10, 10});
  ComparisonConditions conditions;
  conditions.cd_m2_per_unit = 100;
  const double expected = -20 * std::log10(0.751827 - 0.508078);
  EXPECT_NEAR(psnr_pq(test, reference, conditions).front().value, expected, 1e-3);
}

TEST(PsnrPq, SaysWhichShareExceedsTheRangeOfTheStandard) {
  SceneImage reference(4, 1, {1, 1, 1});
  reference.at(0, 0) = {20000, 20000, 20000};
  EXPECT_EQ(by_name(psnr_pq(reference, reference, {})).at("pq_clipped_share"), 0.25);
}

TEST(Ssim, OfConstantImagesIsTheLuminanceTerm) {
  const double a = 0.2, b = 0.7, c1 = 1e-4;
  const double expected = (2 * a * b + c1) / (a * a + b * b + c1);
  for (const auto& [width, height] : {std::pair{32, 20}, {11, 11}, {5, 8}, {1, 1}, {1, 30}}) {
    const auto rows = ssim_gamma(grey(width, height, 0.2f), grey(width, height, 0.7f), {});
    EXPECT_NEAR(rows.front().value, expected, 1e-5) << width << "×" << height;
  }
}

TEST(Ssim, MapCoversTheWindowsInsideTheImage) {
  const Plane<float> map = ssim_map(grey(32, 20, 0.2f), grey(32, 20, 0.2f), {});
  EXPECT_EQ(map.width(), 22);
  EXPECT_EQ(map.height(), 10);
  const Plane<float> tiny = ssim_map(grey(4, 20, 0.2f), grey(4, 20, 0.2f), {});
  EXPECT_EQ(tiny.width(), 1);
  EXPECT_EQ(tiny.height(), 10);
}

/// Equation 13 summed straight over one 11×11 window, the definition without separable filters.
double ssim_of_one_window(const DisplayImage& a, const DisplayImage& b) {
  double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 11; ++x) {
      const double w = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2 * 1.5 * 1.5));
      weights += w;
      ma += w * static_cast<double>(luminance(a.at(x, y)));
      mb += w * static_cast<double>(luminance(b.at(x, y)));
    }
  }
  ma /= weights, mb /= weights;
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 11; ++x) {
      const double w = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2 * 1.5 * 1.5)) / weights;
      const double da = static_cast<double>(luminance(a.at(x, y))) - ma;
      const double db = static_cast<double>(luminance(b.at(x, y))) - mb;
      aa += w * da * da, bb += w * db * db, ab += w * da * db;
    }
  }
  const double c1 = 1e-4, c2 = 9e-4;
  return (2 * ma * mb + c1) * (2 * ab + c2) / ((ma * ma + mb * mb + c1) * (aa + bb + c2));
}

TEST(Ssim, AgreesWithItsDefinitionSummedDirectly) {
  DisplayImage a(11, 11), b(11, 11);
  RandomStream random(3, 1, 4);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a.pixels()[i] = {random.next_float(), random.next_float(), random.next_float()};
    b.pixels()[i] = 0.6f * a.pixels()[i] + Rgb{0.4f, 0.4f, 0.4f} * random.next_float();
  }
  EXPECT_NEAR(ssim_gamma(a, b, {}).front().value, ssim_of_one_window(a, b), 1e-6);
}

TEST(Ssim, IsNegativeForAnInvertedPattern) {
  DisplayImage a(16, 16), b(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const float v = (x + y) % 2 == 0 ? 0.1f : 0.9f;
      a.at(x, y) = {v, v, v};
      b.at(x, y) = {1 - v, 1 - v, 1 - v};
    }
  }
  EXPECT_LT(ssim_gamma(a, b, {}).front().value, -0.9);
}

TEST(Ssim, NeedsAWindowOfValidPixels) {
  Mask valid(20, 20, 1);
  for (int i = 0; i < 20; ++i) valid.at(i, i) = 0;
  valid.at(5, 14) = 0, valid.at(14, 5) = 0;
  ComparisonConditions conditions;
  conditions.valid = &valid;
  EXPECT_THROW(ssim_gamma(grey(20, 20, 0.1f), grey(20, 20, 0.1f), conditions), InputError);
}

TEST(Difference, ReportsBiasMagnitudeAndQuantilesOfAKnownPattern) {
  DisplayImage reference = grey(10, 10, 0.5f), test = reference;
  for (int i = 0; i < 10; ++i)
    test.at(i, 0).r = 0.5f + 0.02f * static_cast<float>(i + 1);  // 0.02 … 0.20 in a tenth
  ComparisonConditions conditions;
  conditions.difference_threshold = 0.11;
  const auto rows = by_name(difference_gamma(test, reference, conditions));
  EXPECT_NEAR(rows.at("mean_difference_r"), 0.011, 1e-6);
  EXPECT_NEAR(rows.at("mean_abs_difference_r"), 0.011, 1e-6);
  EXPECT_NEAR(rows.at("rms_difference_r"), std::sqrt(0.0004 * 385 / 100), 1e-6);
  EXPECT_NEAR(rows.at("max_abs_difference_r"), 0.20, 1e-6);
  EXPECT_EQ(rows.at("abs_difference_p50_r"), 0);
  EXPECT_NEAR(rows.at("abs_difference_p95_r"), 0.05 * 0.12 + 0.95 * 0.10, 1e-6);
  EXPECT_NEAR(rows.at("share_above_threshold_r"), 0.05, 1e-12);
  EXPECT_EQ(rows.at("max_abs_difference_g"), 0);
  EXPECT_NEAR(rows.at("share_above_threshold"), 0.05, 1e-12);
}

TEST(Inferno, FollowsThePublishedTable) {
  // Entries 0 … 255 of matplotlib's inferno (van der Walt & Smith 2015). The fit is off by up to 0.035 in
  // blue and 0.013 in red and green.
  const std::vector<std::pair<int, Rgb>> table{
      {0, {0.001462f, 0.000466f, 0.013866f}},   {32, {0.129285f, 0.047293f, 0.290788f}},
      {64, {0.341500f, 0.062325f, 0.429425f}},  {96, {0.540920f, 0.134729f, 0.415123f}},
      {128, {0.735683f, 0.215906f, 0.330245f}}, {160, {0.894305f, 0.353399f, 0.193584f}},
      {192, {0.978422f, 0.557937f, 0.034931f}}, {224, {0.974638f, 0.797692f, 0.206332f}},
      {255, {0.988362f, 0.998364f, 0.644924f}}};
  for (const auto& [entry, published] : table) {
    const Rgb colour = inferno(static_cast<float>(entry) / 255);
    EXPECT_NEAR(colour.r, published.r, 0.013f) << entry;
    EXPECT_NEAR(colour.g, published.g, 0.013f) << entry;
    EXPECT_NEAR(colour.b, published.b, 0.035f) << entry;
  }
}

TEST(Inferno, GrowsInLuminance) {
  for (int i = 0; i < 64; ++i) {
    EXPECT_LT(luminance(inferno(static_cast<float>(i) / 64)),
              luminance(inferno(static_cast<float>(i + 1) / 64)));
  }
}

TEST(ErrorMap, ColoursTheLargestChannelDifferenceAndMarksInvalidPixels) {
  DisplayImage reference = grey(3, 1, 0.5f), test = reference;
  test.at(1, 0).b = 0.625f;
  Mask valid(3, 1, 1);
  valid.at(2, 0) = 0;
  ComparisonConditions conditions;
  conditions.valid = &valid;
  const ErrorMapOptions options;
  const DisplayImage map = error_map(test, reference, conditions, options);
  EXPECT_EQ(map.at(0, 0), inferno(0));
  EXPECT_EQ(map.at(1, 0), inferno(0.5f));
  EXPECT_EQ(map.at(2, 0), options.invalid);
  ErrorMapOptions bad;
  bad.full_scale = 0;
  EXPECT_THROW(error_map(test, reference, conditions, bad), InputError);
}

}  // namespace
}  // namespace plenolab
