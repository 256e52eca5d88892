#include "analysis/psychophysics/welch.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
#include "tests/analysis/psychophysics/reference.h"

namespace plenolab {
namespace {

constexpr SampleSummary kSupersampled{0.1870, 0.1577, 1000}, kReprojected{0.1794, 0.1511, 1000},
    kDirect{0.0184, 0.0027, 1000};
// R's data set "sleep".
const std::vector<double> kSleep1{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0},
    kSleep2{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

double of(const WelchTest& test, const std::string& quantity) {
  if (quantity.ends_with("_t")) return test.t;
  if (quantity.ends_with("_df")) return test.degrees_of_freedom;
  if (quantity.ends_with("_log10p")) return test.log10_p;
  if (quantity.ends_with("_p")) return test.p_two_sided;
  if (quantity.ends_with("_lo95")) return test.difference.low;
  return quantity.ends_with("_hi95") ? test.difference.high : std::numeric_limits<double>::quiet_NaN();
}

TEST(Welch, IsThatOfRFromSummariesAndFromValues) {
  expect_reference("welch", 12, 1e-9, [](const ReferenceRow& row) {
    if (row.quantity.starts_with("SS_vs_DS")) return of(welch_test(kSupersampled, kDirect), row.quantity);
    if (row.quantity.starts_with("noSS_vs_DS")) return of(welch_test(kReprojected, kDirect), row.quantity);
    if (row.quantity.starts_with("SS_vs_noSS"))
      return of(welch_test(kSupersampled, kReprojected), row.quantity);
    return of(welch_test(summarise(kSleep1), summarise(kSleep2)), row.quantity);
  });
}

TEST(Welch, ThePublishedRunTimesGiveAPFarBelowThePrintFloorOfR) {
  const WelchTest test = welch_test(kSupersampled, kDirect);
  EXPECT_NEAR(test.t, 33.80, 0.005);
  EXPECT_NEAR(test.log10_p, -166.9, 0.05);
}

TEST(Welch, LogarithmOfPNeitherUnderflowsNorLosesDigits) {
  // ν = 1 (Cauchy): p = 1 − 2 atan(t)/π = 2 atan(1/t)/π.
  for (const double t : {1e-6, 0.5, 1.0, 3.0, 1e3, 1e150})
    EXPECT_NEAR(log10_student_p(t, 1), std::log10(2 * std::atan(1 / t) / std::acos(-1.0)),
                1e-12 * std::max(1.0, std::log10(t)))
        << t;
  // ν = 2: p = 1 − t/√(2 + t²).
  for (const double t : {0.1, 2.0, 30.0})
    EXPECT_NEAR(std::pow(10, log10_student_p(t, 2)), 2 / (2 + t * t) / (1 + t / std::sqrt(2 + t * t)), 1e-13);
  // Nearly normal: p = erfc(t/√2); asymptotically log p = −t²/2 − log(t √(π/2)) − 1/t².
  EXPECT_NEAR(std::pow(10, log10_student_p(1.96, 1e12)), std::erfc(1.96 / std::sqrt(2)), 1e-11);
  EXPECT_NEAR(log10_student_p(100, 1e15) * std::log(10),
              -5000 - std::log(100 * std::sqrt(std::acos(-1.0) / 2)) - 1e-4, 1e-5);
  EXPECT_EQ(log10_student_p(0, 5), 0);
  EXPECT_LT(log10_student_p(-1e5, 1e6), -1e4);
}

TEST(Welch, RefusesWhatHasNoTest) {
  EXPECT_THROW(welch_test({1, 0, 10}, {2, 0, 10}), InputError);
  EXPECT_THROW(welch_test({1, 1, 1}, {2, 1, 10}), InputError);
  EXPECT_THROW(welch_test({1, -1, 10}, {2, 1, 10}), InputError);
  EXPECT_THROW(summarise(std::vector<double>{1}), InputError);
}

/// Values in sequence with autocorrelation `r` at lag 1.
std::vector<double> sequence(double r, std::size_t n, std::uint64_t seed) {
  RandomStream random(seed, 1, 0);
  std::vector<double> values{0};
  while (values.size() < n) values.push_back(r * values.back() + random.next_double() - 0.5);
  return values;
}

TEST(BlockBootstrap, CorrelatedFramesGetWiderIntervals) {
  const auto a = sequence(0.9, 2000, 1), b = sequence(0.9, 2000, 2);
  const int block = block_length_for(a);
  EXPECT_GT(block, 10);
  EXPECT_EQ(block_length_for(sequence(0, 2000, 3)), 1);
  const auto width = [&](int length) {
    const Interval i = block_bootstrap_difference(a, b, {.resamples = 400, .block_length = length});
    EXPECT_LE(i.low, i.estimate);
    EXPECT_GE(i.high, i.estimate);
    return i.high - i.low;
  };
  // The mean of an AR(1) sequence has √((1 + r)/(1 − r)) = 4.4 times the error of independent values.
  EXPECT_GT(width(block), 2.5 * width(1));
}

TEST(BlockBootstrap, AgreesWithWelchForIndependentValues) {
  const auto a = sequence(0, 500, 4), b = sequence(0, 500, 5);
  const Interval boot = block_bootstrap_difference(a, b, {.resamples = 4000});
  const Interval welch = welch_test(summarise(a), summarise(b)).difference;
  EXPECT_NEAR(boot.low, welch.low, 0.1 * (welch.high - welch.low));
  EXPECT_NEAR(boot.high, welch.high, 0.1 * (welch.high - welch.low));
}

}  // namespace
}  // namespace plenolab
