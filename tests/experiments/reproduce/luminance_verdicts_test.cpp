#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "experiments/reproduce/luminance/luminance_tools.h"
#include "experiments/reproduce/luminance/quality_verdicts.h"
#include "experiments/reproduce/luminance/widened_display.h"

namespace plenolab {
namespace {

/// Gains at 100 positions of which a share, spread evenly, exceeds the threshold of 0.5 dB.
std::vector<double> gains_with(double share) {
  std::vector<double> gains;
  double hits = 0;
  for (int i = 0; i < 100; ++i) {
    const bool hit = std::floor((i + 1) * share + 1e-9) > hits;
    hits += hit ? 1 : 0;
    gains.push_back(hit ? 2.0 : -0.1);
  }
  return gains;
}

Outcome certain_areas(double share) {
  const std::vector<double> gains = gains_with(share);
  return decide_certain_areas(share_above(gains, 0.5, 1), gains.size()).outcome;
}

Outcome most_positions(double share) {
  const std::vector<double> gains = gains_with(share);
  return decide_most_positions(share_above(gains, 0.5, 1), gains.size()).outcome;
}

TEST(LuminanceVerdicts, CertainAreasMustExistAndMustNotBeTheRule) {
  EXPECT_EQ(certain_areas(0), Outcome::kRefuted) << "no position at all is no area";
  EXPECT_EQ(certain_areas(0.2), Outcome::kConfirmed);
  EXPECT_EQ(certain_areas(0.5), Outcome::kUndecided);
  EXPECT_EQ(certain_areas(0.7), Outcome::kRefuted) << "most of the line is not certain areas of it";
  EXPECT_EQ(certain_areas(1), Outcome::kRefuted);
  EXPECT_EQ(certain_areas(0.01), Outcome::kUndecided) << "one position may be chance";
}

TEST(LuminanceVerdicts, RefutedAreasNameTheBoundThatTheyMiss) {
  const Verdict none = decide_certain_areas({0, 0, 0}, 49), many = decide_certain_areas({0.7, 0.6, 0.8}, 49);
  EXPECT_EQ(none.comparison, Comparison::kAbove);
  EXPECT_EQ(none.threshold, 0);
  EXPECT_EQ(many.comparison, Comparison::kBelow);
  EXPECT_EQ(many.threshold, 0.5);
}

TEST(LuminanceVerdicts, MostPositionsAreMoreThanHalfOfThem) {
  EXPECT_EQ(most_positions(0), Outcome::kRefuted);
  EXPECT_EQ(most_positions(0.2), Outcome::kRefuted);
  EXPECT_EQ(most_positions(0.5), Outcome::kUndecided);
  EXPECT_EQ(most_positions(0.7), Outcome::kConfirmed);
}

TEST(LuminanceVerdicts, APositionCountsOnceAndFewDecideNothing) {
  const Verdict verdict = decide_most_positions(share_above(gains_with(0.7), 0.5, 1), 100);
  EXPECT_NE(verdict.uncertainty.find("100 positions"), std::string::npos) << verdict.uncertainty;
  const Interval few = share_above({1, 1, 1}, 0.5, 1);
  EXPECT_EQ(few.low, 0);
  EXPECT_EQ(few.high, 1);
  EXPECT_EQ(decide_certain_areas(share_above({0, 0, 0}, 0.5, 1), 3).outcome, Outcome::kUndecided);
}

TEST(LuminanceVerdicts, SharesStayBetweenNothingAndAll) {
  for (const double share : {0.0, 0.01, 0.2, 0.99, 1.0}) {
    const Interval interval = share_above(gains_with(share), 0.5, 1);
    EXPECT_NEAR(interval.estimate, share, 1e-12);
    EXPECT_GE(interval.low, 0);
    EXPECT_LE(interval.high, 1);
  }
}

TEST(LuminanceVerdicts, TheWidestAreaIsTheLongestRunOfPositions) {
  EXPECT_EQ(widest_area_m({}, 0.5, 0.2), 0);
  EXPECT_EQ(widest_area_m({0, 1, 1, 0, 1, 1, 1, 0, 1}, 0.5, 0.2), 3 * 0.2);
}

TEST(LuminanceVerdicts, TrendsAreSaidAsTheyAre) {
  EXPECT_EQ(trend_text({0.8, 0.6, 0.5}), "falls from 0.800 to 0.500");
  EXPECT_EQ(trend_text({0.677, 0.735, 0.805}), "grows from 0.677 to 0.805");
  EXPECT_EQ(trend_text({0.5, 0.7, 0.4}), "goes over 0.500, 0.700, 0.400");
  EXPECT_EQ(trend_text({0.5, 0.5}), "goes over 0.500, 0.500");
}

TEST(LuminanceErrors, WhereTheTruePictureIsUndefinedThereIsNoErrorRatherThanNone) {
  EXPECT_EQ(difference(3.0, 1.0), 2);
  EXPECT_FALSE(difference(3.0, std::nullopt));
  EXPECT_FALSE(difference(std::nullopt, 1.0));
  EXPECT_NEAR(*rms_of_defined({3.0, std::nullopt, 4.0}), std::sqrt(12.5), 1e-12) << "not diluted by a zero";
  EXPECT_FALSE(rms_of_defined({std::nullopt}));
}

TEST(WidenedDisplay, ChangesNothingButTheWidthOfTheProfile) {
  const ProjectorDisplay display({.projectors = 24, .width = 8, .height = 2});
  const WidenedDisplay same(display, 1), wide(display, 2);
  const Ray ray{7, 3, 1};
  const double x = display.position(ray).x_m, spacing = display.spread_m(7);
  EXPECT_EQ(same.weight(ray, {x + 0.3 * spacing, 0}), display.weight(ray, {x + 0.3 * spacing, 0}));
  EXPECT_NEAR(wide.weight(ray, {x + spacing, 0}), 0.5, 1e-12);
  EXPECT_EQ(wide.reach_m(), 2 * display.reach_m());
  EXPECT_THROW(WidenedDisplay(display, 0.1), InputError);
}

TEST(WidenedDisplay, SpreadAndBruteForceAgreeWhereOneProjectorIsSeenAtAPlace) {
  const ProjectorDisplay display({.projectors = 24, .width = 30, .height = 2});
  RayValues<float> luminance(display.size());
  for (int k = 0; k < 24; ++k)
    for (int u = 0; u < 30; ++u)
      for (int v = 0; v < 2; ++v) luminance.at({k, u, v}) = k % 2 == 0 ? 1.0f : 1000.0f;
  const auto distance = [&](const RayDisplay& shown) {
    const ObserverSamples samples = samples_of(shown, 20);
    const auto estimate = [&](LuminanceMethod method) {
      return estimate_luminance(shown, luminance, samples,
                                {.method = method, .pinhole = {30, 2}, .threads = 1});
    };
    const GlobalLuminance brute = estimate(LuminanceMethod::kBruteForce),
                          spread = estimate(LuminanceMethod::kSpread);
    double mean = 0;
    for (std::size_t i = 0; i < brute.ln_luminance.size(); ++i)
      mean += (brute.ln_luminance[i] - spread.ln_luminance[i]) / 20;
    return mean;
  };
  EXPECT_GT(distance(display), 0.5);
  EXPECT_LT(distance(WidenedDisplay(display, 0.334)), 0.1 * distance(display));
}

}  // namespace
}  // namespace plenolab
