#include "analysis/psychophysics/psychometric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

using Levels = std::vector<PsychometricLevel>;

/// The data of tests/data/psychophysics.csv, "quickpsy_lapse".
Levels quickpsy() {
  const std::vector<int> hits{0, 0, 4, 18, 20, 20, 19, 20};
  Levels levels;
  for (std::size_t i = 0; i < hits.size(); ++i)
    levels.push_back({60.0 * static_cast<double>(i), {hits[i], 20}});
  return levels;
}

/// Demo data of psignifit (Schütt et al. 2016): 2AFC, 90 trials a level.
Levels psignifit() {
  const std::vector<std::pair<double, int>> data{{10, 45}, {15, 50}, {20, 44}, {25, 44}, {30, 52},
                                                 {35, 53}, {40, 62}, {45, 64}, {50, 76}, {60, 79},
                                                 {70, 88}, {80, 90}, {100, 90}};
  Levels levels;
  for (const auto& [x, k] : data) levels.push_back({x * 1e-4, {k, 90}});
  return levels;
}

/// x(0.95) − x(0.05) of a normal function, as psignifit states slopes.
double width_of(const PsychometricFit& fit) {
  return psychometric_level(fit, 0.95) - psychometric_level(fit, 0.05);
}

TEST(Psychometric, MaximumLikelihoodIsThatOfTheReferenceWithFixedAndFreeLapses) {
  PsychometricOptions options{.guess_rate = 0};
  const PsychometricFit fixed = fit_psychometric(quickpsy(), options);
  EXPECT_EQ(fixed.status, PsychometricStatus::kFitted);
  EXPECT_NEAR(fixed.location, 151.05118, 2e-5);
  EXPECT_NEAR(fixed.scale, 57.175873, 2e-5);
  options.free_lapse = true;
  const PsychometricFit free = fit_psychometric(quickpsy(), options);
  EXPECT_NEAR(free.location, 142.97789, 2e-4);
  EXPECT_NEAR(free.scale, 27.071645, 2e-4);
  EXPECT_NEAR(free.lapse_rate, 0.0125757, 1e-6);
  EXPECT_NEAR(free.negative_log_likelihood, 21.912505, 1e-6);
}

TEST(Psychometric, MaximumLikelihoodIsThatOfTheReferenceForTwoAlternatives) {
  const PsychometricFit none = fit_psychometric(psignifit(), {});
  EXPECT_NEAR(none.location, 0.00464781705, 1e-9);
  EXPECT_NEAR(none.negative_log_likelihood, 565.955165, 1e-6);
  EXPECT_NEAR(none.deviance, 5.93281, 1e-5);
  const PsychometricFit one = fit_psychometric(psignifit(), {.lapse_rate = 0.01});
  EXPECT_NEAR(one.location, 0.00459349902, 1e-9);
  EXPECT_NEAR(width_of(one), 0.00447789077, 1e-8);
  EXPECT_NEAR(one.negative_log_likelihood, 567.658405, 1e-6);
  const PsychometricFit two = fit_psychometric(psignifit(), {.lapse_rate = 0.02});
  EXPECT_NEAR(two.location, 0.00454156842, 1e-9);
  EXPECT_NEAR(width_of(two), 0.00431219809, 1e-8);
}

/// Many answers exactly in the shares of a function.
Levels expected_answers(const PsychometricFit& truth, const std::vector<double>& at) {
  Levels levels;
  constexpr std::int64_t kTrials = 10'000'000;
  for (const double x : at)
    levels.push_back(
        {x, {static_cast<std::int64_t>(std::llround(psychometric_value(truth, x) * kTrials)), kTrials}});
  return levels;
}

TEST(Psychometric, RecoversTheFunctionOfEveryShape) {
  for (const auto shape :
       {PsychometricShape::kNormal, PsychometricShape::kLogistic, PsychometricShape::kWeibull}) {
    PsychometricFit truth;
    truth.options = {.shape = shape, .free_guess = true, .free_lapse = true};
    truth.location = 3, truth.scale = 0.4, truth.guess_rate = 0.5, truth.lapse_rate = 0.03;
    const auto levels = expected_answers(truth, {0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 7, 9});
    const PsychometricFit fit = fit_psychometric(levels, truth.options);
    EXPECT_NEAR(fit.location, 3, 1e-3);
    EXPECT_NEAR(fit.scale, 0.4, 1e-3);
    EXPECT_NEAR(fit.guess_rate, 0.5, 1e-3);
    EXPECT_NEAR(fit.lapse_rate, 0.03, 1e-4);
    EXPECT_NEAR(psychometric_value(fit, fit.threshold), 0.5 + 0.47 / 2, 1e-3);
  }
}

TEST(Psychometric, DoesNotDependOnTheUnitOfTheLevels) {
  Levels scaled = quickpsy();
  for (PsychometricLevel& level : scaled) level.x = 1e-9 * level.x + 5e-7;
  const PsychometricFit a = fit_psychometric(quickpsy(), {.guess_rate = 0});
  const PsychometricFit b = fit_psychometric(scaled, {.guess_rate = 0});
  EXPECT_NEAR(b.location, 1e-9 * a.location + 5e-7, 1e-14);
  EXPECT_NEAR(b.scale / a.scale, 1e-9, 1e-15);
}

TEST(Psychometric, NamesDataThatDoNotDetermineTheFunction) {
  const PsychometricOptions options{.guess_rate = 0};
  const Levels step{{1, {0, 20}}, {2, {0, 20}}, {3, {20, 20}}, {4, {20, 20}}};
  EXPECT_EQ(fit_psychometric(step, options).status, PsychometricStatus::kSeparable);
  const Levels one_between{{1, {0, 20}}, {2, {7, 20}}, {3, {20, 20}}};
  EXPECT_EQ(fit_psychometric(one_between, options).status, PsychometricStatus::kSeparable);
  const Levels level{{1, {10, 20}}, {2, {10, 20}}, {3, {10, 20}}};
  EXPECT_EQ(fit_psychometric(level, options).status, PsychometricStatus::kFlat);
  const Levels falling{{1, {18, 20}}, {2, {10, 20}}, {3, {2, 20}}};
  EXPECT_EQ(fit_psychometric(falling, options).status, PsychometricStatus::kFlat);
  const Levels all{{1, {20, 20}}, {2, {20, 20}}};
  EXPECT_NE(fit_psychometric(all, options).status, PsychometricStatus::kFitted);
  EXPECT_FALSE(status_text(PsychometricStatus::kFlat).empty());
}

TEST(Psychometric, BootstrapIntervalsHoldTheTruthAboutAsOftenAsPromised) {
  PsychometricFit truth;
  truth.options = {.guess_rate = 0.5};
  truth.location = 0, truth.scale = 1, truth.guess_rate = 0.5;
  int held = 0;
  constexpr int kStudies = 30;
  for (int s = 0; s < kStudies; ++s) {
    RandomStream random(3, 3, static_cast<std::uint64_t>(s));
    Levels levels;
    for (const double x : {-2.0, -1.0, 0.0, 1.0, 2.0, 3.0}) {
      Proportion p{0, 60};
      for (int t = 0; t < 60; ++t) p.hits += random.next_double() < psychometric_value(truth, x) ? 1 : 0;
      levels.push_back({x, p});
    }
    const PsychometricFit fit = fit_psychometric(levels, {.confidence = 0.9, .resamples = 100, .seed = 5});
    ASSERT_TRUE(fit.threshold_interval);
    held += fit.threshold_interval->low <= 0 && 0 <= fit.threshold_interval->high ? 1 : 0;
    EXPECT_TRUE(fit.deviance_p);
  }
  EXPECT_GE(held, 22);  // 27 expected; fewer than 22 has probability 0.008 at 90 %
}

TEST(Psychometric, HugeNumbersOfTrialsAreResampledPromptlyAndTightly) {
  Levels levels = quickpsy();
  for (PsychometricLevel& level : levels)
    level.noticed.hits *= 10'000'000, level.noticed.trials *= 10'000'000;
  const PsychometricFit fit =
      fit_psychometric(levels, {.guess_rate = 0, .free_lapse = true, .resamples = 100});
  ASSERT_TRUE(fit.threshold_interval);
  EXPECT_LT(fit.threshold_interval->high - fit.threshold_interval->low, 0.1);
}

TEST(Psychometric, IsTheSameForTheSameSeed) {
  const PsychometricOptions options{.guess_rate = 0, .resamples = 100, .seed = 9};
  const auto a = fit_psychometric(quickpsy(), options), b = fit_psychometric(quickpsy(), options);
  EXPECT_EQ(a.threshold_interval->low, b.threshold_interval->low);
}

TEST(Psychometric, RefusesWhatCannotBeFitted) {
  EXPECT_THROW(fit_psychometric(Levels{{1, {1, 2}}, {1, {2, 2}}}), InputError);
  EXPECT_THROW(fit_psychometric(Levels{{0, {1, 2}}, {1, {2, 2}}}, {.shape = PsychometricShape::kWeibull}),
               InputError);
  EXPECT_THROW(fit_psychometric(Levels{{-1.7e308, {1, 2}}, {1.7e308, {2, 2}}}), InputError);
  EXPECT_THROW(fit_psychometric(Levels{{1, {3, 2}}, {2, {2, 2}}}), InputError);
  EXPECT_THROW(fit_psychometric(quickpsy(), {.guess_rate = 0.6, .lapse_rate = 0.5}), InputError);
  EXPECT_THROW(fit_psychometric(quickpsy(), {.resamples = 5}), InputError);
}

}  // namespace
}  // namespace plenolab
