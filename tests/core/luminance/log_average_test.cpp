#include "core/luminance/log_average.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

std::vector<float> spread_values(double low, double high, std::size_t count) {
  std::vector<float> x;
  for (std::size_t i = 0; i < count; ++i)
    x.push_back(static_cast<float>(std::pow(10.0, low + (high - low) * unit_double(random_u64(3, 1, i)))));
  return x;
}

double exact_sum(const std::vector<float>& values, double above) {
  double sum = 0;
  for (const float v : values)
    if (static_cast<double>(v) > above) sum += std::log(static_cast<double>(v));
  return sum;
}

TEST(LogAverage, OfTwoEquallyFrequentLevelsIsTheirGeometricMean) {
  std::vector<float> values(1000, 0.5f);
  std::fill(values.begin(), values.begin() + 500, 200.0f);
  EXPECT_NEAR(std::exp(*log_sum(values, {}).ln_average()), 10.0, 1e-5);  // √(0.5·200)
}

TEST(LogAverage, AgreesWithTheSumOfLogarithmsForEveryLengthAndRange) {
  for (const std::size_t length : {1u, 2u, 15u, 16u, 17u, 1023u, 1024u, 1040u, 100'003u})
    for (const auto& [low, high] : {std::pair{-9.0, 9.0}, {-0.1, 0.1}, {-3.9, 4.0}}) {
      const std::vector<float> values = spread_values(low, high, length);
      const LogAverageOptions options{.epsilon = 1e-12};
      const LogSum sum = log_sum(values, options);
      EXPECT_EQ(sum.count, static_cast<double>(length));
      EXPECT_NEAR(sum.ln_sum / sum.count, exact_sum(values, 0) / sum.count, 1e-6) << length;
    }
}

TEST(LogAverage, ManyEqualMantissasNeitherOverflowNorVanish) {
  for (const float value : {1.9999999f, 1.0f, std::numeric_limits<float>::max(), 3e-30f}) {
    const std::vector<float> values(100'000, value);
    EXPECT_NEAR(*log_sum(values, {.epsilon = 1e-30}).ln_average(), std::log(static_cast<double>(value)),
                1e-6);
  }
}

TEST(LogAverage, IgnoresPixelsAtOrBelowTheThreshold) {
  const std::vector<float> values{0, 1e-4f, 9e-5f, 4, 9};
  const LogSum sum = log_sum(values, {.epsilon = static_cast<double>(1e-4f)});
  EXPECT_EQ(sum.count, 2);
  EXPECT_NEAR(*sum.ln_average(), std::log(6.0), 1e-6);
}

TEST(LogAverage, OfNothingAboveTheThresholdIsUndefinedAndNotZero) {
  EXPECT_FALSE(log_sum(std::vector<float>(100, 0.0f), {}).ln_average());
  EXPECT_FALSE(log_sum({}, {}).ln_average());
  EXPECT_FALSE(log_average(SceneImage(4, 3)));
}

TEST(LogAverage, WithAnOffsetCountsBlackPixelsAsTheOffset) {
  const std::vector<float> values{0, 99.99f, 0, 99.99f};
  const LogAverageOptions options{.rule = LogAverageOptions::Rule::kOffset, .delta = 0.01};
  const LogSum sum = log_sum(values, options);
  EXPECT_EQ(sum.count, 4);
  EXPECT_NEAR(std::exp(*sum.ln_average()), 1.0, 1e-5);  // √(0.01·100)
}

TEST(LogAverage, OfAMixtureIsThatOfTheMixedColumns) {
  const std::vector<float> a = spread_values(-3, 3, 133), b = spread_values(-3, 3, 133);
  const float* columns[] = {a.data(), b.data()};
  const float weights[] = {0.25f, 0.75f};
  std::vector<float> mixed;
  for (std::size_t i = 0; i < a.size(); ++i) mixed.push_back(0.25f * a[i] + 0.75f * b[i]);
  EXPECT_NEAR(log_sum_of_mixture(columns, weights, a.size(), {}).ln_sum, log_sum(mixed, {}).ln_sum, 1e-9);
}

TEST(LogAverage, IsTheSameBitByBitOnEveryInstructionSet) {
  const std::vector<float> values = spread_values(-5, 5, 5003);
  std::vector<double> sums;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    sums.push_back(log_sum(values, {}).ln_sum);
  }
  hwy::SetSupportedTargetsForTest(0);
  for (const double sum : sums) EXPECT_EQ(sum, sums.front());
}

TEST(LogAverage, OfAnImageRepairsItsDefectsFirst) {
  SceneImage image(2, 2);
  for (Rgb& c : image.pixels()) c = {10, 10, 10};
  image.at(1, 1) = {std::numeric_limits<float>::quiet_NaN(), -1, -1};
  EXPECT_NEAR(*log_average(image), std::log(10.0), 1e-6);
}

TEST(LogAverage, RefusesThresholdsThatNoLuminanceHas) {
  EXPECT_THROW((LogAverageOptions{.epsilon = 0}).validate(), InputError);
  EXPECT_THROW((LogAverageOptions{.delta = std::nan("")}).validate(), InputError);
}

}  // namespace
}  // namespace plenolab
