// d′, beta-binomial, participant effect and rank correlation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "analysis/psychophysics/beta_binomial.h"
#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/dprime.h"
#include "analysis/psychophysics/participant_effect.h"
#include "analysis/psychophysics/rank_correlation.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "tests/analysis/psychophysics/reference.h"

namespace plenolab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double dprime_for(const ReferenceRow& row) {
  if (row.quantity == "ABX_diff") return dprime_of(row.p, DprimeModel::kAbxDifferencing);
  if (row.quantity == "ABX_IO") return dprime_of(row.p, DprimeModel::kAbxIndependent);
  return row.quantity == "2AFC" ? dprime_of(row.p, DprimeModel::kTwoAlternatives) : kNone;
}

TEST(Dprime, IsThatOfTheReferenceInAllModels) {
  expect_reference("dprime_exact", 25, 1e-11, dprime_for);
  // psyphy itself stops its root search early.
  expect_reference("dprime", 40, 3e-4, dprime_for);
}

TEST(Dprime, HitsAndFalseAlarmsOfAMatchingTaskGoThroughTheUnbiasedShare) {
  const YesNoSensitivity s = yes_no_sensitivity({75, 100}, {30, 100}, false);
  EXPECT_NEAR(dprime_of(s.unbiased_share, DprimeModel::kAbxIndependent), 1.66096748454109, 3e-5);
  EXPECT_NEAR(dprime_of(s.unbiased_share, DprimeModel::kAbxDifferencing), 1.86870047681554, 3e-5);
  EXPECT_NEAR(s.dprime.estimate, 0.674489750196082 + 0.524400512708041, 1e-12);
  EXPECT_NEAR(s.criterion, -0.5 * (0.674489750196082 - 0.524400512708041), 1e-12);
  EXPECT_LT(s.dprime.low, s.dprime.estimate);
}

TEST(Dprime, RisesWithTheShareAndInvertsIt) {
  for (const auto model :
       {DprimeModel::kTwoAlternatives, DprimeModel::kAbxIndependent, DprimeModel::kAbxDifferencing}) {
    EXPECT_NEAR(proportion_correct(0, model), 0.5, 1e-15);
    EXPECT_NEAR(dprime_of(0.5, model), 0, 1e-12);
    for (const double d : {0.05, 0.5, 1.0, 3.0, 6.0})
      EXPECT_NEAR(dprime_of(proportion_correct(d, model), model), d, 1e-6) << d;
    EXPECT_EQ(dprime_of(1, model), std::numeric_limits<double>::infinity());
  }
  EXPECT_EQ(dprime_of(0.3, DprimeModel::kAbxIndependent), 0);
  EXPECT_LT(dprime_of(0.3, DprimeModel::kTwoAlternatives), 0);
  EXPECT_THROW(dprime_of(1.1, DprimeModel::kTwoAlternatives), InputError);
}

TEST(Dprime, AllRightIsFiniteWithTheLogLinearRule) {
  const Interval i = dprime_interval({34, 34}, DprimeModel::kAbxIndependent);
  EXPECT_TRUE(std::isfinite(i.estimate));
  EXPECT_TRUE(std::isfinite(i.low));
  EXPECT_EQ(i.high, std::numeric_limits<double>::infinity());
  EXPECT_EQ(log_linear_rate({34, 34}), 34.5 / 35);
  EXPECT_THROW(yes_no_sensitivity({10, 10}, {0, 10}, false), InputError);
  EXPECT_TRUE(std::isfinite(yes_no_sensitivity({10, 10}, {0, 10}).dprime.high));
}

TEST(BetaBinomial, WithoutOverdispersionItIsTheBinomial) {
  const std::vector<Proportion> people(10, {3, 10});
  const BetaBinomialFit fit = fit_beta_binomial(people);
  EXPECT_NEAR(fit.overdispersion.estimate, 0, 1e-6);
  EXPECT_NEAR(fit.rate.estimate, 0.3, 1e-6);
  EXPECT_GT(fit.p_overdispersed, 0.5);
  EXPECT_NEAR(beta_binomial_log_likelihood(people, 0.3, 0), 30 * std::log(0.3) + 70 * std::log(0.7), 1e-10);
}

// Haseman & Soares 1976-like extremes: P(all hit) of two trials is π² + ρπ(1 − π).
TEST(BetaBinomial, LikelihoodOfTwoTrialsIsThatOfCorrelatedTrials) {
  for (const double rate : {0.2, 0.7})
    for (const double rho : {0.0, 0.3, 0.9}) {
      const double both = rate * rate + rho * rate * (1 - rate);
      const std::vector<Proportion> one{{2, 2}};
      EXPECT_NEAR(beta_binomial_log_likelihood(one, rate, rho), std::log(both), 1e-12);
    }
}

/// Half of the participants always hit with `high`, half with `low`.
std::vector<Proportion> mixed(double low, double high, int people, int trials) {
  std::vector<Proportion> result;
  for (int i = 0; i < people; ++i) {
    RandomStream random(7, 7, static_cast<std::uint64_t>(i));
    Proportion p{0, trials};
    for (int t = 0; t < trials; ++t) p.hits += random.next_double() < (i % 2 ? low : high) ? 1 : 0;
    result.push_back(p);
  }
  return result;
}

TEST(BetaBinomial, FindsParticipantsWhoDiffer) {
  const auto people = mixed(0, 0.5, 34, 10);
  const BetaBinomialFit fit = fit_beta_binomial(people);
  EXPECT_TRUE(fit.identified);
  EXPECT_LT(fit.p_overdispersed, 1e-6);
  EXPECT_GT(fit.overdispersion.low, 0.1);
  EXPECT_GT(fit.design_effect, 2);
  EXPECT_LT(fit.rate.low, 0.25);
  EXPECT_GT(fit.rate.high, 0.25);
  // Wider than the interval that takes all trials for independent.
  Proportion all;
  for (const Proportion& p : people) all.hits += p.hits, all.trials += p.trials;
  const Interval naive = clopper_pearson(all);
  EXPECT_GT(fit.rate.high - fit.rate.low, naive.high - naive.low);
  EXPECT_LT(beta_binomial_posterior_above(people, 0.19), posterior_above(all, 0.19));
}

TEST(BetaBinomial, SaysWhenTheDataCannotTell) {
  EXPECT_FALSE(fit_beta_binomial(std::vector<Proportion>(34, {1, 1})).identified);
  const BetaBinomialFit none = fit_beta_binomial(std::vector<Proportion>(5, {0, 10}));
  EXPECT_FALSE(none.identified);
  EXPECT_EQ(none.rate.low, 0);
  EXPECT_EQ(none.overdispersion.high, 1);
  EXPECT_THROW(fit_beta_binomial({}), InputError);
}

/// One trial of each of five images by each of `people`: even ones answer by the rates `even`, odd by `odd`.
std::vector<StudyTrial> observed(int people, const std::array<double, 5>& even,
                                 const std::array<double, 5>& odd, std::uint64_t seed) {
  std::vector<StudyTrial> trials;
  for (int p = 0; p < people; ++p) {
    RandomStream random(seed, 11, static_cast<std::uint64_t>(p));
    const auto& rates = p % 2 == 0 ? even : odd;
    for (std::size_t i = 0; i < rates.size(); ++i) {
      StudyTrial trial;
      trial.participant = fmt::format("P{}", p);
      trial.display = "monitor";
      trial.image = fmt::format("{}", i);
      trial.chose_test = random.next_double() < rates[i];
      trials.push_back(trial);
    }
  }
  return trials;
}

/// Sums of the same trials, which ignore that images have rates of their own.
std::vector<Proportion> sums_of(const std::vector<StudyTrial>& trials) {
  std::map<std::string, Proportion> sums;
  for (const StudyTrial& trial : trials) {
    ++sums[trial.participant].trials;
    sums[trial.participant].hits += trial.chose_test ? 1 : 0;
  }
  std::vector<Proportion> result;
  for (const auto& entry : sums) result.push_back(entry.second);
  return result;
}

TEST(ParticipantEffect, FindsParticipantsWhoDifferThoughImagesDifferMore) {
  const auto trials = observed(200, {0, 0, 0.9, 0.9, 0.25}, {0.1, 0.1, 1, 1, 0.75}, 3);
  EXPECT_EQ(fit_beta_binomial(sums_of(trials)).p_overdispersed, 1);  // what sums alone would say
  const auto effect = participant_effect(trials);
  ASSERT_TRUE(effect);
  EXPECT_LT(effect->p_value, 0.01);
  EXPECT_GT(effect->correlation.low, 0);
  EXPECT_GE(effect->correlation.estimate, effect->correlation.low);
  EXPECT_LE(effect->correlation.estimate, effect->correlation.high);
}

TEST(ParticipantEffect, AlikeParticipantsDifferAsOftenAsAlphaSays) {
  constexpr int kStudies = 200;
  const std::array<double, 5> rates{0.05, 0.2, 0.9, 0.8, 0.5};
  int differ = 0, covered = 0;
  for (int s = 0; s < kStudies; ++s) {
    const auto effect = participant_effect(observed(34, rates, rates, static_cast<std::uint64_t>(100 + s)),
                                           {.confidence = 0.95, .resamples = 199});
    ASSERT_TRUE(effect);
    differ += effect->p_value <= 0.05 ? 1 : 0;
    covered += effect->correlation.low <= 0 && effect->correlation.high >= 0 ? 1 : 0;
  }
  EXPECT_LE(differ, 20);  // binomial(200, 0.05): more than 20 with probability 0.0013
  EXPECT_GE(differ, 1);
  EXPECT_GE(covered, 170);
}

TEST(ParticipantEffect, TwoKindsWhoAlwaysDifferCorrelateFully) {
  const auto effect = participant_effect(observed(40, {1, 1, 1, 1, 1}, {0, 0, 0, 0, 0}, 5));
  ASSERT_TRUE(effect);
  EXPECT_NEAR(effect->correlation.estimate, 1, 1e-12);
  EXPECT_EQ(effect->p_value, 1.0 / 2000);
}

TEST(ParticipantEffect, LeavesOutCatchTrialsAndSaysWhenItCannotTell) {
  auto trials = observed(34, {0.2, 0.3, 0.4, 0.5, 0.6}, {0.4, 0.5, 0.6, 0.7, 0.8}, 6);
  const auto effect = participant_effect(trials);
  ASSERT_TRUE(effect);
  StudyTrial caught = trials[0];
  caught.is_catch = true;
  caught.chose_test = !caught.chose_test;
  trials.push_back(caught);
  EXPECT_EQ(participant_effect(trials)->correlation.estimate, effect->correlation.estimate);
  EXPECT_FALSE(participant_effect({}));
  EXPECT_FALSE(participant_effect(observed(1, {0.5, 0.5, 0.5, 0.5, 0.5}, {}, 6)));
  EXPECT_FALSE(participant_effect(observed(9, {0, 0, 1, 1, 1}, {0, 0, 1, 1, 1}, 6)));
  EXPECT_THROW(participant_effect(trials, {.resamples = 9}), InputError);
}

TEST(RankCorrelation, OrderAloneCountsAndTheExactPIsThatOfTheTables) {
  const std::array<double, 5> x{1, 2, 3, 4, 5}, same{10, 20, 25, 90, 1000}, reversed{5, 4, 3, 2, 1};
  const RankCorrelation up = rank_correlation(x, same);
  EXPECT_NEAR(up.rho.estimate, 1, 1e-15);
  EXPECT_NEAR(up.p_two_sided, 2.0 / 120, 1e-15);
  EXPECT_EQ(up.smallest_p, up.p_two_sided);
  EXPECT_NEAR(rank_correlation(x, reversed).rho.estimate, -1, 1e-15);
  // ρ = 0.9 with n = 5: two-sided 0.0833 (Owen 1962).
  EXPECT_NEAR(rank_correlation(x, std::array<double, 5>{2, 1, 3, 4, 5}).p_two_sided, 10.0 / 120, 1e-12);
}

TEST(RankCorrelation, HandlesTiesAndRefusesWhatHasNoOrder) {
  // R: cor(c(1,2,2,4), c(1,3,2,4), method = "spearman") = 0.9486833
  const std::array<double, 4> tied{1, 2, 2, 4}, other{1, 3, 2, 4};
  EXPECT_NEAR(rank_correlation(tied, other).rho.estimate, 0.948683298050514, 1e-12);
  EXPECT_THROW(rank_correlation(std::array<double, 4>{1, 1, 1, 1}, other), InputError);
  EXPECT_THROW(rank_correlation(std::array<double, 3>{1, 2, 3}, std::array<double, 3>{1, 2, 3}), InputError);
}

}  // namespace
}  // namespace plenolab
