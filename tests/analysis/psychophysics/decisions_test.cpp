// Multiplicity, equivalence and planning.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/equivalence.h"
#include "analysis/psychophysics/multiplicity.h"
#include "analysis/psychophysics/planning.h"
#include "analysis/psychophysics/study_table.h"
#include "core/base/error.h"
#include "tests/analysis/psychophysics/reference.h"

namespace plenolab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Adjusted p values of the ten counts of a table, by count.
std::map<std::int64_t, double> adjusted(const ReferenceRow& row, bool by_holm) {
  const std::array<std::int64_t, 10> main{12, 21, 16, 15, 6, 19, 18, 11, 16, 6};
  const std::array<std::int64_t, 10> initial{25, 20, 15, 18, 8, 13, 17, 17, 11, 2};
  const auto& counts = row.n == 34 ? main : initial;
  std::vector<double> p_values;
  for (const std::int64_t k : counts)
    p_values.push_back(row.p == 0.5 ? two_sided_p(k, row.n, 0.5) : upper_tail(k, row.n, row.p));
  const std::vector<double> values = by_holm ? holm(p_values) : benjamini_hochberg(p_values);
  std::map<std::int64_t, double> by_count;
  for (std::size_t i = 0; i < counts.size(); ++i) by_count[counts[i]] = values[i];
  return by_count;
}

TEST(Multiplicity, AdjustedPValuesAreThoseOfR) {
  expect_reference("holm", 25, 1e-9, [](const ReferenceRow& row) { return adjusted(row, true).at(row.k); });
  expect_reference("BH", 25, 1e-9, [](const ReferenceRow& row) { return adjusted(row, false).at(row.k); });
}

TEST(Multiplicity, NeverLowersAPValueAndKeepsTheOrder) {
  const std::vector<double> p{0.04, 0.001, 0.5, 0.04, 1, 0};
  for (const auto& method : {holm, benjamini_hochberg}) {
    const std::vector<double> q = method(p);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_GE(q[i], p[i]);
      EXPECT_LE(q[i], 1);
      for (std::size_t j = 0; j < p.size(); ++j)
        if (p[i] < p[j]) {
          EXPECT_LE(q[i], q[j]);
        }
    }
  }
  EXPECT_TRUE(holm({}).empty());
  EXPECT_EQ(holm(std::vector<double>{0.03})[0], 0.03);
  EXPECT_THROW(holm(std::vector<double>{kNone}), InputError);
}

TEST(Multiplicity, TenRowsAtTheirActualSizeGiveTheFamilyErrorOfTheReference) {
  expect_reference("fwer", 1, 1e-9, [](const ReferenceRow& row) {
    StudyOptions options;
    options.p_null = row.p;
    options.alpha = row.alpha;
    std::vector<StudyCount> counts(10, {"display", "", {row.k, row.n}, 0, ""});
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i].image = std::to_string(i);
    return analyse_counts(counts, options).any_false_pass;
  });
}

TEST(Equivalence, PValuesAndPowerAreThoseOfTheReference) {
  expect_reference("tost_exact", 17, 1e-9, [](const ReferenceRow& row) {
    return equivalence_p({row.k, row.n}, {.margin = row.p, .alpha = row.alpha});
  });
  expect_reference("tost_power", 6, 1e-9, [](const ReferenceRow& row) {
    return equivalence_power(row.n, 0.5, {.margin = row.p, .alpha = row.alpha});
  });
  expect_reference("noninf", 10, 1e-9,
                   [](const ReferenceRow& row) { return upper_tail(row.k, row.n, row.p); });
}

TEST(Equivalence, NoCountOf34TrialsCanShowAMarginOf15Percent) {
  EXPECT_TRUE(equivalence_region(34).empty());
  for (std::int64_t k = 0; k <= 34; ++k) EXPECT_GE(equivalence_p({k, 34}), 0.05) << k;
}

TEST(Equivalence, TheRegionHoldsExactlyTheCountsWhosePValueIsBelowAlpha) {
  for (const std::int64_t n : {1, 33, 34, 40, 69, 100, 227})
    for (const double margin : {0.05, 0.1, 0.15, 0.2, 0.5})
      for (const double centre : {0.4, 0.5}) {
        if (margin > centre) continue;
        const EquivalenceOptions options{.centre = centre, .margin = margin};
        const EquivalenceRegion region = equivalence_region(n, options);
        for (std::int64_t k = 0; k <= n; ++k)
          EXPECT_EQ(region.contains(k), equivalence_p({k, n}, options) < 0.05) << k << " of " << n;
      }
}

TEST(Equivalence, RefusesMarginsThatLeaveTheUnitInterval) {
  EXPECT_THROW(equivalence_region(34, {.margin = 0}), InputError);
  EXPECT_THROW(equivalence_region(34, {.margin = 0.6}), InputError);
  EXPECT_THROW(equivalence_p({1, 34}, {.alpha = 1}), InputError);
}

TEST(Planning, PowerIsThatOfR) {
  expect_reference("power", 60, 1e-9, [](const ReferenceRow& row) {
    const double p_true = std::stod(row.quantity.substr(row.quantity.find('=') + 1));
    // R gives 0 below its smallest number, and two values lie where double has lost 1e-9.
    return row.value == 0 ? kNone : test_power(row.n, row.p, p_true, row.alpha);
  });
  expect_reference("guessers", 8, 1e-9, [](const ReferenceRow& row) {
    return test_power(row.n, 0.19, row.p / 2);  // half of the guesses are wrong
  });
}

/// The number behind a word, as in "first_n_power0.80_pnull.19".
double number_after(const std::string& text, const std::string& word) {
  return std::stod(text.substr(text.find(word) + word.size()));
}

TEST(Planning, SampleSizesAreThoseFoundByTryingEveryNumber) {
  expect_reference("sample_size", 15, 0, [](const ReferenceRow& row) {
    const SampleSize size = plan_test({.p_null = number_after(row.quantity, "pnull"),
                                       .p_true = row.p,
                                       .alpha = row.alpha,
                                       .power = number_after(row.quantity, "power")});
    return static_cast<double>(row.quantity.starts_with("first") ? size.first : size.stable);
  });
  expect_reference("tost_sample_size", 4, 0, [](const ReferenceRow& row) {
    const SampleSize size =
        plan_equivalence({.margin = row.p, .alpha = row.alpha}, 0.5, number_after(row.quantity, "power"));
    return static_cast<double>(size.stable);
  });
}

TEST(Planning, PowerStaysAboveTheTargetFromTheStableSizeOn) {
  const SampleSize size = plan_test({.p_true = 0.35, .power = 0.9});
  EXPECT_LT(size.first, size.stable);
  EXPECT_LT(test_power(size.first - 1, 0.19, 0.35), 0.9);
  EXPECT_LT(test_power(size.stable - 1, 0.19, 0.35), 0.9);
  const std::vector<double> curve = power_curve(0.19, 0.35, 0.05, 1000);
  for (std::int64_t n = size.stable; n <= 1000; ++n)
    EXPECT_GE(curve[static_cast<std::size_t>(n - 1)], 0.9) << n;
  EXPECT_NEAR(curve[33], test_power(34, 0.19, 0.35), 1e-14);
}

TEST(Planning, RefusesWhatCannotBePlanned) {
  EXPECT_THROW(plan_test({.p_null = 0.5, .p_true = 0.5}), InputError);
  EXPECT_THROW(plan_test({.p_null = 0.5, .p_true = 0.5001}), InputError);
  EXPECT_THROW(plan_test({.power = 1}), InputError);
  EXPECT_THROW(plan_equivalence({}, 0.7), InputError);
}

}  // namespace
}  // namespace plenolab
