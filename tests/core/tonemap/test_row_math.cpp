#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <hwy/targets.h>
#include <cmath>

#include "core/base/random.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/row_math.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

std::vector<float> log_spread(double low, double high, std::size_t count) {
  std::vector<float> x(count);
  for (std::size_t i = 0; i < count; ++i)
    x[i] = static_cast<float>(
        std::pow(10.0, low + (high - low) * static_cast<double>(i) / static_cast<double>(count)));
  return x;
}

TEST(RowMath, LogsAreWithinTheStatedErrorFromDenormalsToTheLargestFloat) {
  const std::vector<float> x = log_spread(-44, 38.5, 40'003);
  std::vector<float> y(x.size());
  log10_row(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double exact = std::log10(static_cast<double>(x[i]));
    ASSERT_NEAR(static_cast<double>(y[i]), exact, 2e-7 + 1.5e-7 * std::abs(exact)) << x[i];
  }
}

TEST(RowMath, PowersOfTenAreWithinTheStatedErrorAndNeverInfinite) {
  std::vector<float> x;
  for (int i = -3700; i <= 3850; ++i) x.push_back(static_cast<float>(i) * 0.01f);
  x.insert(x.end(), {-1e30f, 39.0f, 1e30f});
  std::vector<float> y(x.size());
  exp10_row(x, y);
  for (std::size_t i = 0; i + 3 < x.size(); ++i) {
    const double exact = std::pow(10.0, static_cast<double>(x[i]));
    ASSERT_NEAR(static_cast<double>(y[i]) / exact, 1.0, 2e-7 + 4e-7 * std::abs(static_cast<double>(x[i])))
        << x[i];
  }
  EXPECT_EQ(y[x.size() - 3], 0.0f);
  EXPECT_EQ(y[x.size() - 2], std::numeric_limits<float>::max());
  EXPECT_EQ(y[x.size() - 1], std::numeric_limits<float>::max());
}

TEST(RowMath, PowersAreWithinTheStatedErrorAndExactAtZeroAndOne) {
  for (const float p : {0.0f, 0.3f, 0.4545454f, 0.7f, 1.0f, 2.2f}) {
    std::vector<float> x = log_spread(-12, 12, 10'001);
    x.insert(x.end(), {0.0f, 1.0f});
    std::vector<float> y(x.size());
    power_row(x, p, y);
    for (std::size_t i = 0; i + 2 < x.size(); ++i) {
      const double t = static_cast<double>(p) * std::log2(static_cast<double>(x[i]));
      if (t < -125) continue;
      const double exact = std::exp2(t);
      ASSERT_NEAR(static_cast<double>(y[i]) / exact, 1.0, 3e-7 * (1 + std::abs(t))) << x[i] << "^" << p;
    }
    EXPECT_EQ(y[x.size() - 2], p == 0 ? 1.0f : 0.0f);
    EXPECT_EQ(y[x.size() - 1], 1.0f);
  }
}

/// Restricts Highway to one instruction set for as long as it lives.
struct OnlyTarget {
  explicit OnlyTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnlyTarget() { hwy::SetSupportedTargetsForTest(0); }
};

TEST(RowMath, ResultsAreTheSameBitsOnEveryInstructionSetAndPixelByPixel) {
  const std::vector<float> x = log_spread(-40, 38, 1003);
  std::vector<float> best(x.size()), other(x.size());
  power_row(x, 0.6f, best);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const OnlyTarget only(target);
    for (std::size_t i = 0; i < x.size(); ++i) power_row({x.data() + i, 1}, 0.6f, {other.data() + i, 1});
    EXPECT_EQ(best, other) << hwy::TargetName(target);
  }
}

TEST(ColourRatio, ColourlessPixelsStayColourlessAndBlackOnesGetTheLumaItself) {
  const std::vector<Rgb> scene{{0.3f, 0.3f, 0.3f}, {0, 0, 0}, {1e9f, 1e9f, 1e9f}, {1e-30f, 1e-30f, 1e-30f}};
  const std::vector<float> luma{0.5f, 0.25f, 1.0f, 0.125f};
  std::vector<Rgb> out(scene.size());
  EXPECT_EQ(apply_colour_ratio(scene, luma, 0.7, out), 0);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    EXPECT_EQ(out[i].r, out[i].g);
    EXPECT_EQ(out[i].g, out[i].b);
    EXPECT_NEAR(out[i].g, luma[i], 1e-6f);
  }
}

TEST(ColourRatio, CountsWhatIsAboveOneAndMatchesTheFormula) {
  const std::vector<Rgb> scene{{1.0f, 0.5f, 0.25f}, {0, 0, 1.0f}};
  const std::vector<float> luma{0.5f, 0.9f};
  std::vector<Rgb> out(2);
  EXPECT_EQ(apply_colour_ratio(scene, luma, 0.5, out), 1);
  const double l = 0.2126 + 0.7152 * 0.5 + 0.0722 * 0.25;
  EXPECT_NEAR(out[0].r, 0.5 * std::sqrt(1.0 / l), 1e-6);
  EXPECT_NEAR(out[0].b, 0.5 * std::sqrt(0.25 / l), 1e-6);
  EXPECT_EQ(out[1], (Rgb{0, 0, 1}));
}

TEST(ColourRatio, ExponentZeroGivesGrey) {
  const std::vector<Rgb> scene{{1.0f, 0.5f, 0.25f}};
  std::vector<Rgb> out(1);
  apply_colour_ratio(scene, std::vector<float>{0.5f}, 0, out);
  EXPECT_EQ(out[0], (Rgb{0.5f, 0.5f, 0.5f}));
}

}  // namespace
}  // namespace plenolab
