#include "experiments/reproduce/claims/claim_statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"

namespace plenolab {
namespace {

TEST(ClaimStatistics, FewValuesGetStudentsInterval) {
  // Mean 2, standard deviation 1, t_2(0.975) = 4.30265 (tables of Student's t): half width 4.30265/√3.
  const std::array values{1.0, 2.0, 3.0};
  const Interval interval = *mean_interval(values, 1);
  EXPECT_DOUBLE_EQ(interval.estimate, 2);
  EXPECT_NEAR(interval.high - 2, 4.3026527 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(2 - interval.low, 4.3026527 / std::sqrt(3.0), 1e-6);
}

TEST(ClaimStatistics, OneValueOrOneBlockIsNoMeasurement) {
  EXPECT_FALSE(mean_interval(std::array{1.0}, 1));
  EXPECT_FALSE(mean_interval(std::array{1.0, 2.0}, 1, 2));
}

TEST(ClaimStatistics, IntervalsOfThreeNormalValuesHoldTheMeanAsOftenAsTheySay) {
  int held = 0;
  constexpr int kTrials = 2000;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values;
    for (std::uint64_t i = 0; i < 3; ++i) {
      // Box and Muller's normal deviates.
      const double u = unit_double(random_u64(7, 1, 3 * trial + i)),
                   v = unit_double(random_u64(7, 2, 3 * trial + i));
      values.push_back(std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * 3.14159265358979 * v));
    }
    const Interval interval = *mean_interval(values, 1);
    held += interval.low <= 0 && 0 <= interval.high ? 1 : 0;
  }
  // Four standard deviations of a binomial share of 0.95.
  EXPECT_NEAR(static_cast<double>(held) / kTrials, 0.95, 4 * std::sqrt(0.95 * 0.05 / kTrials));
}

TEST(ClaimStatistics, AFewRatiosOfSumsHaveAnIntervalAroundTheRatio) {
  const std::array above{1.0, 2.0, 3.1}, below{2.0, 4.0, 6.0};
  const auto ratio = [&](std::span<const double> drawn) {
    double a = 0, b = 0;
    for (const double i : drawn) {
      a += above[static_cast<std::size_t>(i)];
      b += below[static_cast<std::size_t>(i)];
    }
    return a / b;
  };
  const Interval interval = bootstrap_units(3, ratio, 1);
  EXPECT_DOUBLE_EQ(interval.estimate, 6.1 / 12);
  EXPECT_LT(interval.low, 0.5);
  EXPECT_GT(interval.high, 3.1 / 6);
}

TEST(ClaimStatistics, ARatioThatLosesItsDenominatorWithOneUnitIsBoundedByNothing) {
  const std::array above{1.0, 2.0, 3.0}, below{0.0, 4.0, 0.0};
  const auto ratio = [&](std::span<const double> drawn) {
    double a = 0, b = 0;
    for (const double i : drawn) {
      a += above[static_cast<std::size_t>(i)];
      b += below[static_cast<std::size_t>(i)];
    }
    return b > 0 ? a / b : std::numeric_limits<double>::infinity();
  };
  const Interval interval = bootstrap_units(3, ratio, 1);
  EXPECT_DOUBLE_EQ(interval.estimate, 1.5);
  EXPECT_EQ(interval.low, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(interval.high, std::numeric_limits<double>::infinity());
}

TEST(ClaimStatistics, TheUncertaintySaysWhatItRestsOn) {
  EXPECT_EQ(uncertainty_over(3, "lines of motion"), "95 % Student interval over 3 lines of motion");
  EXPECT_EQ(uncertainty_over(24, "views"), "95 % bootstrap over 24 views");
  EXPECT_EQ(uncertainty_over(8, "views", 2), "95 % Student interval over 8 views, 2 together");
}

}  // namespace
}  // namespace plenolab
