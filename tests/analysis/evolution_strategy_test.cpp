#include "analysis/evolution_strategy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace plenolab {
namespace {

ScoreAll one_by_one(std::function<double(const std::vector<double>&)> score) {
  return [score](std::span<const std::vector<double>> candidates) {
    std::vector<double> scores;
    for (const auto& candidate : candidates) scores.push_back(score(candidate));
    return scores;
  };
}

std::vector<SearchParameter> square(double start = 0.9) {
  return {{"x", start, -1, 1}, {"y", -start, -1, 1}};
}

double bowl(const std::vector<double>& p) {
  return std::pow(p[0] - 0.3, 2) + 4 * std::pow(p[1] + 0.2, 2);
}

TEST(EvolutionStrategy, FindsTheBottomOfABowlWhateverTheSeed) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Evolution found = minimise_by_evolution(square(), one_by_one(bowl), {.seed = seed});
    EXPECT_LT(found.score, 2e-3) << seed;
    EXPECT_TRUE(found.converged);
  }
}

TEST(EvolutionStrategy, NeverGetsWorseAndStaysWithinRanges) {
  // The minimum lies outside: the search ends at the border.
  const auto slope = one_by_one([](const std::vector<double>& p) {
    EXPECT_LE(std::abs(p[0]), 1);
    EXPECT_LE(std::abs(p[1]), 1);
    return p[0] + p[1];
  });
  const Evolution found = minimise_by_evolution(square(), slope, {.deviation = 3});
  for (std::size_t i = 1; i < found.trace.size(); ++i)
    EXPECT_LE(found.trace[i].score, found.trace[i - 1].score);
  EXPECT_EQ(found.best, (std::vector<double>{-1, -1}));
  EXPECT_EQ(found.trace.back().score, found.score);
}

TEST(EvolutionStrategy, IsDeterministicForASeedOnly) {
  const auto run = [](std::uint64_t seed) {
    return minimise_by_evolution(square(), one_by_one(bowl), {.most_iterations = 5, .seed = seed}).best;
  };
  EXPECT_EQ(run(7), run(7));
  EXPECT_NE(run(7), run(8));
}

TEST(EvolutionStrategy, ShrinksItsStepsAndStopsAfterSixWithoutProgress) {
  const Evolution flat = minimise_by_evolution(square(), one_by_one([](const auto&) { return 1.0; }));
  ASSERT_EQ(flat.trace.size(), 7u);
  EXPECT_TRUE(flat.converged);
  EXPECT_EQ(flat.best, (std::vector<double>{0.9, -0.9}));
  EXPECT_DOUBLE_EQ(flat.trace[1].deviation, 0.5);
  EXPECT_DOUBLE_EQ(flat.trace[6].deviation, 0.5 * std::pow(0.8, 5));
  EXPECT_EQ(flat.trace[6].evaluations, 61);
}

TEST(EvolutionStrategy, DeviationsAreNormalInTheUnitAskedFor) {
  for (const bool relative : {false, true}) {
    double squares = 0;
    int count = 0;
    const std::vector<SearchParameter> wide{{"x", 0, -500, 500}};
    minimise_by_evolution(
        wide,
        [&](std::span<const std::vector<double>> candidates) {
          for (const auto& c : candidates) {
            squares += c[0] * c[0];
            ++count;
          }
          return std::vector<double>(candidates.size(), 1.0);
        },
        {.children = 4000, .deviation = 0.02, .relative_deviation = relative, .most_iterations = 1});
    const double expected = relative ? 20.0 : 0.02;
    // Four standard errors of a deviation estimated from 4000 values.
    EXPECT_NEAR(std::sqrt(squares / (count - 1)), expected, 4 * expected / std::sqrt(2.0 * 4000));
  }
}

TEST(EvolutionStrategy, LeavesOutScoresThatAreNoNumbers) {
  const auto holes = one_by_one([](const std::vector<double>& p) {
    if (p[0] < 0.5) return std::numeric_limits<double>::quiet_NaN();
    return p[0] < 0.6 ? std::numeric_limits<double>::infinity() : p[0];
  });
  const Evolution found = minimise_by_evolution(square(), holes);
  EXPECT_GE(found.best[0], 0.6);
  EXPECT_LT(found.best[0], 0.7);
  EXPECT_THROW(minimise_by_evolution(square(0.2), holes), InputError);
}

TEST(EvolutionStrategy, RefusesOptionsAndRangesThatAreNone) {
  const auto run = [](std::vector<SearchParameter> parameters, EvolutionOptions options) {
    minimise_by_evolution(parameters, one_by_one(bowl), options);
  };
  EXPECT_THROW(run({}, {}), InputError);
  EXPECT_THROW(run({{"x", 2, 0, 1}, {"y", 0, 0, 1}}, {}), InputError);
  EXPECT_THROW(run({{"x", 0, 0, 0}, {"y", 0, 0, 1}}, {}), InputError);
  EXPECT_THROW(run(square(), {.children = 0}), InputError);
  EXPECT_THROW(run(square(), {.deviation = 0}), InputError);
  EXPECT_THROW(run(square(), {.shrink = 1.1}), InputError);
  EXPECT_THROW(run(square(), {.patience = 0}), InputError);
  EXPECT_NO_THROW(run(square(), {.most_iterations = 0}));
}

}  // namespace
}  // namespace plenolab
