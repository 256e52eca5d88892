#include "analysis/psychophysics/binomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "tests/analysis/psychophysics/reference.h"

namespace plenolab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(Binomial, CriticalNumbersAndTheirTailsAreThoseOfR) {
  expect_reference("critical_number", 60, 1e-9, [](const ReferenceRow& row) {
    const std::int64_t critical = critical_number(row.n, row.p, row.alpha);
    if (row.quantity == "i_c") return static_cast<double>(critical);
    return upper_tail(row.quantity == "tail_at_ic" ? critical : critical - 1, row.n, row.p);
  });
}

TEST(Binomial, ExactTestsGiveThePValuesOfR) {
  expect_reference("binom_test", 40, 1e-9, [](const ReferenceRow& row) {
    if (row.quantity == "p_greater") return upper_tail(row.k, row.n, row.p);
    if (row.quantity == "p_less") return lower_tail(row.k, row.n, row.p);
    return row.quantity == "p_two_sided" ? two_sided_p(row.k, row.n, row.p) : kNone;
  });
}

TEST(Binomial, CriticalNumberIsTheFirstWhoseTailIsBelowAlpha) {
  for (const std::int64_t n : {1, 2, 3, 7, 34, 40, 100, 999})
    for (const double p : {0.0, 1e-12, 0.01, 0.19, 0.5, 0.93, 1 - 1e-12, 1.0})
      for (const double alpha : {1e-9, 0.05, 0.4}) {
        std::int64_t first = 0;
        while (upper_tail(first, n, p) >= alpha * (1 - 1e-12)) ++first;
        EXPECT_EQ(critical_number(n, p, alpha), first) << n << ' ' << p << ' ' << alpha;
      }
}

TEST(Binomial, ATailThatEqualsAlphaIsNotBelowIt) {
  EXPECT_EQ(critical_number(10, 0.5, 11.0 / 1024), 10);  // P(X ≥ 9) = 11/1024
  EXPECT_EQ(critical_number(4, 0.5, 0.0625), 5);         // not even four of four
}

// The first by summing tails with 30 digits (mpmath) from the mean on.
TEST(Binomial, FindsCriticalNumbersOfHugeStudies) {
  EXPECT_EQ(critical_number(100'000'000, 0.19, 0.05), 19'006'454);
  EXPECT_NEAR(upper_tail(19'006'454, 100'000'000, 0.19), 0.0499855929428736, 1e-10);
  for (const double p : {1e-12, 0.19, 0.5, 1 - 1e-12}) {
    const std::int64_t critical = critical_number(kMostTrials, p, 0.05);
    EXPECT_LT(upper_tail(critical, kMostTrials, p), 0.05) << p;
    EXPECT_GE(upper_tail(critical - 1, kMostTrials, p), 0.05) << p;
  }
}

TEST(Binomial, NoCountPassesWhereEverySuccessIsLikely) {
  EXPECT_EQ(critical_number(5, 1, 0.05), 6);
  EXPECT_EQ(critical_number(0, 0.19, 0.05), 1);
  EXPECT_EQ(critical_number(1000, 0, 0.05), 1);
}

TEST(Binomial, TailsAddUpToOne) {
  for (const std::int64_t n : {1, 34, 1'000, 1'000'000, 1'000'000'000})
    for (const double p : {1e-12, 1e-3, 0.19, 0.5, 0.999, 1 - 1e-12}) {
      const auto middle = static_cast<std::int64_t>(static_cast<double>(n) * p);
      EXPECT_NEAR(lower_tail(middle, n, p) + upper_tail(middle + 1, n, p), 1, 1e-9) << n << ' ' << p;
    }
}

// mpmath 50 digits: log of I_p(k, n − k + 1)
TEST(Binomial, FarTailsNeitherUnderNorOverflow) {
  EXPECT_NEAR(log_upper_tail(1000, 1000, 1e-12), 1000 * std::log(1e-12), 1e-9);
  EXPECT_NEAR(log_lower_tail(0, 1'000'000'000, 0.5), 1e9 * std::log(0.5), 1e-3);
  EXPECT_NEAR(log_upper_tail(1, 1'000'000'000, 1e-12), std::log(-std::expm1(1e9 * std::log1p(-1e-12))),
              1e-12);
  EXPECT_NEAR(log_lower_tail(999'999'999, 1'000'000'000, 1 - 1e-12),
              std::log(-std::expm1(1e9 * std::log1p(-(1 - (1 - 1e-12))))), 1e-9);
  EXPECT_NEAR(log_upper_tail(500, 1000, 0.19) / -245.9925251101298, 1, 1e-11);
  EXPECT_NEAR(log_upper_tail(900000, 1000000, 0.5) / -368070.71210762437, 1, 1e-11);
  EXPECT_NEAR(log_upper_tail(190100000, 1000000000, 0.19) / -35.504736358712411, 1, 1e-11);
  EXPECT_NEAR(log_upper_tail(25, 1000000000, 1e-12) / -230.69844903528658, 1, 1e-11);
  EXPECT_NEAR(log_upper_tail(500100000, 1000000000, 0.5) / -22.786775621823525, 1, 1e-11);
}

// Few failures in very many trials are Poisson to 1e-8: P(Y ≤ 2) with mean 10 is 61 e^{-10}; the difference
// is that of P(Y = k) = C(n, k) q^k (1 − q)^(n − k), summed.
TEST(Binomial, KeepsItsDigitsWhereAlmostEveryTrialHits) {
  constexpr double kMiss = 0x1p-27, kTrials = 1e9;
  const double none = std::exp(kTrials * std::log1p(-kMiss)), odds = kMiss / (1 - kMiss);
  const double sum = none * (1 + kTrials * odds + kTrials * (kTrials - 1) / 2 * odds * odds);
  EXPECT_NEAR(upper_tail(999'999'998, 1'000'000'000, 1 - kMiss) / sum, 1, 1e-12);
  EXPECT_NEAR(lower_tail(2, 1'000'000'000, kMiss) / sum, 1, 1e-12);
}

TEST(Binomial, ProbabilitiesSumToOneAndMatchTheirRatio) {
  double sum = 0;
  for (int k = 0; k <= 50; ++k) sum += std::exp(log_binomial_probability(k, 50, 0.19));
  EXPECT_NEAR(sum, 1, 1e-13);
  const double ratio = log_binomial_probability(8, 50, 0.19) - log_binomial_probability(7, 50, 0.19);
  EXPECT_NEAR(ratio, std::log(43.0 / 8 * 0.19 / 0.81), 1e-13);
  EXPECT_EQ(log_binomial_probability(-1, 50, 0.19), -std::numeric_limits<double>::infinity());
}

TEST(Binomial, TailsFallWithTheCountAndRiseWithTheRate) {
  for (std::int64_t i = 1; i <= 34; ++i) {
    EXPECT_LT(upper_tail(i, 34, 0.19), upper_tail(i - 1, 34, 0.19));
    EXPECT_LT(upper_tail(i, 34, 0.19), upper_tail(i, 34, 0.2));
  }
}

TEST(Binomial, TwoSidedTestIsOneAtTheMeanAndSymmetricForAHalf) {
  EXPECT_EQ(two_sided_p(17, 34, 0.5), 1);
  for (std::int64_t k = 0; k <= 34; ++k)
    EXPECT_NEAR(two_sided_p(k, 34, 0.5), two_sided_p(34 - k, 34, 0.5), 1e-12) << k;
  EXPECT_EQ(two_sided_p(0, 10, 0), 1);
  EXPECT_EQ(two_sided_p(1, 10, 0), 0);
}

TEST(Binomial, RefusesWhatIsNoProbability) {
  EXPECT_THROW(critical_number(10, 1.5), InputError);
  EXPECT_THROW(critical_number(-1, 0.5), InputError);
  EXPECT_THROW(critical_number(10, 0.5, 0), InputError);
  EXPECT_THROW(upper_tail(1, kMostTrials + 1, 0.5), InputError);
  EXPECT_THROW(upper_tail(1, 10, kNone), InputError);
}

}  // namespace
}  // namespace plenolab
