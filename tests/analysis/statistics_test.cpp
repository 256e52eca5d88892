#include "analysis/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

double mean_of(std::span<const double> values) {
  return mean(values);
}

TEST(Statistics, AgreeWithRForASmallSample) {
  const std::vector<double> v{3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_DOUBLE_EQ(mean(v), 3.875);
  EXPECT_DOUBLE_EQ(median(v), 3.5);
  EXPECT_DOUBLE_EQ(quantile(v, 0.25), 1.75);  // R: quantile(v, .25)
  EXPECT_DOUBLE_EQ(quantile(v, 0.9), 6.9);
  EXPECT_DOUBLE_EQ(quantile(v, 1), 9);
}

TEST(Statistics, RefuseWhatHasNoAnswer) {
  EXPECT_THROW(mean({}), InputError);
  const std::vector<double> broken{1, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(median(broken), InputError);
  const std::vector<double> one{2};
  EXPECT_THROW(quantile(one, 1.5), InputError);
}

TEST(Bootstrap, CoversTheTrueMeanAboutAsOftenAsItClaims) {
  BootstrapOptions options;
  options.confidence = 0.9;
  options.resamples = 300;
  int covered = 0;
  constexpr int kTrials = 400;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    RandomStream random(11, 1, trial);
    std::vector<double> values(40);
    for (double& v : values) v = random.next_double() + random.next_double();  // mean 1
    options.seed = trial;
    const Interval interval = bootstrap_interval(values, mean_of, options);
    covered += interval.low <= 1 && 1 <= interval.high;
  }
  // Binomial(400, 0.9) has a standard deviation of 0.015; the percentile interval is slightly short at n
  // = 40.
  EXPECT_NEAR(covered / static_cast<double>(kTrials), 0.89, 0.045);
}

TEST(Bootstrap, GivesTheSameIntervalForTheSameSeedOnly) {
  const std::vector<double> v{1, 2, 4, 8, 16, 32};
  BootstrapOptions options;
  const Interval a = bootstrap_interval(v, mean_of, options), b = bootstrap_interval(v, mean_of, options);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  options.seed = 2;
  const Interval c = bootstrap_interval(v, mean_of, options);
  EXPECT_TRUE(c.low != a.low || c.high != a.high);
}

TEST(Bootstrap, BlocksWidenTheIntervalOfValuesInSequence) {
  std::vector<double> slow(200);
  for (std::size_t i = 0; i < slow.size(); ++i) slow[i] = std::sin(static_cast<double>(i) * 0.05);
  BootstrapOptions single, blocks;
  blocks.block_length = 40;
  const Interval narrow = bootstrap_interval(slow, mean_of, single),
                 wide = bootstrap_interval(slow, mean_of, blocks);
  EXPECT_GT(wide.high - wide.low, 2 * (narrow.high - narrow.low));
}

TEST(Bootstrap, OfEqualValuesHasNoWidth) {
  const std::vector<double> v(9, 2.5);
  const Interval interval = bootstrap_interval(v, mean_of);
  EXPECT_EQ(interval.low, 2.5);
  EXPECT_EQ(interval.estimate, 2.5);
  EXPECT_EQ(interval.high, 2.5);
}

TEST(Bootstrap, RefusesUnusableOptions) {
  const std::vector<double> v{1, 2};
  BootstrapOptions options;
  options.confidence = 1;
  EXPECT_THROW(bootstrap_interval(v, mean_of, options), InputError);
  options = {};
  options.resamples = 3;
  EXPECT_THROW(bootstrap_interval(v, mean_of, options), InputError);
  options = {};
  options.block_length = 0;
  EXPECT_THROW(bootstrap_interval(v, mean_of, options), InputError);
}

}  // namespace
}  // namespace plenolab
