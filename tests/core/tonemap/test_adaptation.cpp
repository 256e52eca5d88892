#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/base/error.h"
#include "core/tonemap/adaptation.h"

namespace plenolab {
namespace {

constexpr AdaptationOptions kHeld{}, kLinear{.scheme = AdaptationScheme::kLinearTarget},
    kEuler{.scheme = AdaptationScheme::kExplicitEuler};

/// Value after `seconds` of frames at `rate` Hz that follow target(t) from `start` at t = 0.
double run(const AdaptationOptions& options, double start, double rate, double seconds,
           const std::function<double(double)>& target) {
  std::optional<Adapted<double>> state = Adapted<double>{start, target(0)};
  const int frames = static_cast<int>(std::lround(rate * seconds));
  for (int i = 1; i <= frames; ++i) state = adapt(options, state, target(i / rate), 1 / rate);
  return state->value;
}

TEST(Adaptation, AHeldTargetIsReachedAlikeAt24And60And120HzAndExactly) {
  for (const AdaptationOptions& options : {kHeld, kLinear}) {
    const double exact = 5 + (2 - 5) * std::exp(-0.5 / kRodAdaptation_s);
    for (const double rate : {24.0, 60.0, 120.0, 1000.0})
      EXPECT_NEAR(run(options, 2, rate, 0.5, [](double) { return 5.0; }), exact, 1e-12) << rate;
  }
}

TEST(Adaptation, ExplicitEulerDependsOnTheRateAndDivergesForLongSteps) {
  const auto target = [](double) { return 5.0; };
  const double exact = 5 + (2 - 5) * std::exp(-0.5 / kRodAdaptation_s);
  EXPECT_GT(std::abs(run(kEuler, 2, 24, 0.5, target) - exact), 0.02);
  EXPECT_GT(std::abs(run(kEuler, 2, 2, 10, target)), 1e3);  // Δt = 0.5 s > 2·t0
  EXPECT_NEAR(run(kHeld, 2, 2, 10, target), 5, 1e-12);
}

TEST(Adaptation, StepsFromNothingToHoursStayBetweenStateAndTarget) {
  for (const AdaptationOptions& options : {kHeld, kLinear})
    for (const double step :
         {0.0, 1e-300, 1e-12, 1e-3, 0.15, 10.0, 3600.0, 1e7, std::numeric_limits<double>::infinity()}) {
      const AdaptationWeights w = adaptation_weights(options, step);
      EXPECT_NEAR(w.state + w.previous_target + w.target, 1, 1e-15) << step;
      for (const double one : {w.state, w.previous_target, w.target}) {
        EXPECT_GE(one, -1e-16) << step;
        EXPECT_LE(one, 1) << step;
      }
      const double value = adapt(options, Adapted<double>{1, 1}, 3, step).value;
      EXPECT_GE(value, 1) << step;
      EXPECT_LE(value, 3) << step;
    }
  EXPECT_EQ(adapt(kHeld, Adapted<double>{1, 1}, 3, 0).value, 1);
  EXPECT_EQ(adapt(kHeld, Adapted<double>{1, 1}, 3, 3600).value, 3);
}

TEST(Adaptation, OnARampTheHeldTargetLagsByRateAndTheLinearOneByTheTimeConstant) {
  const auto ramp = [](double t) { return 10 * t; };
  const auto lag = [&](const AdaptationOptions& o, double rate) { return 4 - run(o, 0, rate, 4, ramp) / 10; };
  for (const double rate : {30.0, 120.0}) {
    const double step = 1 / rate;
    EXPECT_NEAR(lag(kHeld, rate), step / std::expm1(step / kRodAdaptation_s), 1e-9) << rate;
    EXPECT_NEAR(lag(kLinear, rate), kRodAdaptation_s, 1e-9) << rate;
  }
  EXPECT_NEAR(lag(kHeld, 120) - lag(kHeld, 30), 0.012, 5e-4);
}

TEST(Adaptation, WithoutAPreviousStateOrTimeConstantTheTargetIsTaken) {
  EXPECT_EQ(adapt(kHeld, std::nullopt, 3, 0.01), (Adapted<double>{3, 3}));
  EXPECT_EQ(adapt({.time_constant_s = 0}, Adapted<double>{1, 1}, 3, 0.01).value, 3);
}

TEST(Adaptation, EveryNumberOfStatisticsFollowsLikeASingleOne) {
  ImageStatistics from, to;
  from.log_p99 = 1, to.log_p99 = 2, to.average_colour = {4, 5, 6}, to.log_robust_average = -3;
  to.average_luminance = 7, to.log_average = 8, to.log_min = 9, to.log_max = 10, to.log_p1 = 11;
  const ImageStatistics s = adapt(kHeld, Adapted<ImageStatistics>{from, from}, to, 0.1).value;
  const auto one = [](double a, double b) { return adapt(kHeld, Adapted<double>{a, a}, b, 0.1).value; };
  EXPECT_EQ(s.log_p99, one(1, 2));
  EXPECT_EQ(s.average_colour[1], one(0, 5));
  EXPECT_EQ(s.average_luminance, one(0, 7));
  EXPECT_EQ(s.log_average, one(0, 8));
  EXPECT_EQ(s.log_min, one(0, 9));
  EXPECT_EQ(s.log_max, one(0, 10));
  EXPECT_EQ(s.log_p1, one(0, 11));
  EXPECT_EQ(s.log_robust_average, one(0, -3));
}

TEST(Adaptation, BadTimesAreErrors) {
  EXPECT_THROW(adapt(kHeld, std::nullopt, 1, -0.1), InputError);
  EXPECT_THROW(adapt(kHeld, std::nullopt, 1, std::nan("")), InputError);
  EXPECT_THROW(adapt({.time_constant_s = -1}, std::nullopt, 1, 0.1), InputError);
  EXPECT_THROW(adapt({.time_constant_s = INFINITY}, std::nullopt, 1, 0.1), InputError);
}

}  // namespace
}  // namespace plenolab
