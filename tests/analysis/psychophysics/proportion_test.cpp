#include "analysis/psychophysics/proportion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/psychophysics/binomial.h"
#include "core/base/error.h"
#include "tests/analysis/psychophysics/reference.h"

namespace plenolab {
namespace {

double end_of(const Interval& interval, const ReferenceRow& row) {
  return row.quantity.starts_with("lower") ? interval.low : interval.high;
}

TEST(Proportion, IntervalsAreThoseOfR) {
  expect_reference("clopper_pearson", 50, 1e-9, [](const ReferenceRow& row) {
    return end_of(clopper_pearson({row.k, row.n}, 1 - row.alpha), row);
  });
  expect_reference("wilson", 20, 1e-9, [](const ReferenceRow& row) {
    return end_of(wilson({row.k, row.n}, 1 - row.alpha), row);
  });
  expect_reference("jeffreys", 20, 1e-9, [](const ReferenceRow& row) {
    return end_of(jeffreys({row.k, row.n}, 1 - row.alpha), row);
  });
}

TEST(Proportion, PosteriorIsThatOfR) {
  expect_reference("bayes", 13, 1e-9, [](const ReferenceRow& row) {
    return posterior_above({row.k, row.n}, row.p);
  });
}

TEST(Proportion, ClopperPearsonEndsHaveTheirTails) {
  for (const std::int64_t n : {1, 10, 34, 1000, 100'000, 1'000'000'000})
    for (const double share : {0.0, 0.1, 0.5, 0.97, 1.0}) {
      const auto k = static_cast<std::int64_t>(static_cast<double>(n) * share);
      const Interval i = clopper_pearson({k, n}, 0.95);
      const double tolerance = n > 1'000'000 ? 1e-6 : 1e-9;
      if (k > 0) {
        EXPECT_NEAR(upper_tail(k, n, i.low), 0.025, tolerance) << k << " of " << n;
      }
      if (k < n) {
        EXPECT_NEAR(lower_tail(k, n, i.high), 0.025, tolerance) << k << " of " << n;
      }
    }
}

TEST(Proportion, NoHitsAndAllHitsGiveIntervalsWithWidth) {
  // (α/2)^(1/n): Clopper & Pearson's ends in closed form.
  EXPECT_NEAR(clopper_pearson({0, 34}).high, 1 - std::pow(0.025, 1.0 / 34), 1e-14);
  EXPECT_NEAR(clopper_pearson({34, 34}).low, std::pow(0.025, 1.0 / 34), 1e-14);
  for (const auto& method : {clopper_pearson, wilson, jeffreys}) {
    EXPECT_EQ(method({0, 34}, 0.95).low, 0);
    EXPECT_EQ(method({34, 34}, 0.95).high, 1);
    EXPECT_GT(method({0, 34}, 0.95).high, 0.05);
    EXPECT_LT(method({34, 34}, 0.95).low, 0.95);
  }
}

TEST(Proportion, ClopperPearsonCoversAtLeastAsPromised) {
  for (const double p : {0.02, 0.19, 0.35, 0.5, 0.8}) {
    double covered = 0;
    for (std::int64_t k = 0; k <= 34; ++k) {
      const Interval i = clopper_pearson({k, 34}, 0.95);
      if (i.low <= p && p <= i.high) covered += std::exp(log_binomial_probability(k, 34, p));
    }
    EXPECT_GE(covered, 0.95) << p;
  }
}

TEST(Proportion, IntervalsOfFailuresMirrorThoseOfHits) {
  for (const auto& method : {clopper_pearson, wilson, jeffreys}) {
    const Interval hits = method({11, 34}, 0.9), misses = method({23, 34}, 0.9);
    EXPECT_NEAR(hits.low, 1 - misses.high, 1e-12);
    EXPECT_NEAR(hits.high, 1 - misses.low, 1e-12);
  }
}

TEST(Proportion, RefusesImpossibleCounts) {
  EXPECT_THROW(clopper_pearson({5, 4}), InputError);
  EXPECT_THROW(wilson({0, 0}), InputError);
  EXPECT_THROW(jeffreys({-1, 4}), InputError);
  EXPECT_THROW(clopper_pearson({1, 4}, 1), InputError);
  EXPECT_THROW(posterior_above({1, 4}, 0.5, {0, 1}), InputError);
}

}  // namespace
}  // namespace plenolab
