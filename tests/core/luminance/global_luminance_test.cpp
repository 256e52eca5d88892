#include "core/luminance/global_luminance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "tests/core/luminance/ray_fixtures.h"

namespace plenolab {
namespace {

using Kind = LensArrayDisplayOptions::Kind;
constexpr LuminanceMethod kMethods[] = {LuminanceMethod::kAll, LuminanceMethod::kBruteForce,
                                        LuminanceMethod::kAccumulative, LuminanceMethod::kSpread};
constexpr DisplaySpace kPlane{.x_min_m = -0.5, .x_max_m = 0.5, .y_min_m = -0.3, .y_max_m = 0.3};

LuminanceOptions with(LuminanceMethod method, const RayDisplay& display) {
  return {.method = method, .pinhole = display.resolution(), .threads = 1};
}

void expect_all(const GlobalLuminance& estimate, double luminance, double tolerance, const char* what) {
  ASSERT_TRUE(estimate.known()) << what;
  for (const double ln : estimate.ln_luminance) EXPECT_NEAR(ln, std::log(luminance), tolerance) << what;
}

TEST(GlobalLuminance, OfAConstantDisplayIsItsLuminanceForEveryMethodAndExtreme) {
  const ProjectorDisplay display = small_projectors();
  for (const double level : {1e-9, 2e-4, 1.0, 137.0, 1e9}) {
    const auto luminance = luminance_by(display, [=](const Ray&) { return level; });
    for (const LuminanceMethod method : kMethods) {
      LuminanceOptions options = with(method, display);
      options.average.epsilon = 1e-12;
      expect_all(estimate_luminance(display, luminance, samples_of(display, 50), options), level, 1e-6,
                 name_of(method));
    }
  }
}

TEST(GlobalLuminance, OfABlackDisplayIsUndefinedEverywhere) {
  const ProjectorDisplay display = small_projectors();
  const auto black = luminance_by(display, [](const Ray&) { return 1e-5; });
  for (const LuminanceMethod method : kMethods) {
    const GlobalLuminance estimate =
        estimate_luminance(display, black, samples_of(display, 20), with(method, display));
    EXPECT_FALSE(estimate.known());
    EXPECT_EQ(estimate.undefined(), 20);
    EXPECT_FALSE(estimate.ln_at({0, 0}));
  }
}

TEST(GlobalLuminance, OfOneProjectorIsThatOfItsPictureForBruteForce) {
  const ProjectorDisplay display = small_projectors(1);
  const auto luminance = random_luminance(display, -3, 3);
  const LuminanceOptions all = with(LuminanceMethod::kAll, display),
                         brute = with(LuminanceMethod::kBruteForce, display);
  const ObserverSamples samples = samples_of(display, 9);
  const double expected = estimate_luminance(display, luminance, samples, all).ln_luminance[0];
  for (const double ln : estimate_luminance(display, luminance, samples, brute).ln_luminance)
    EXPECT_NEAR(ln, expected, 1e-6);
}

TEST(GlobalLuminance, OfTwoHalvesOfThePictureIsTheirGeometricMean) {
  // Upper half 0.01, lower half 400 cd/m²: √4 = 2 from everywhere.
  const ProjectorDisplay display = small_projectors();
  const auto luminance = luminance_by(display, [](const Ray& ray) { return ray.v < 10 ? 0.01 : 400.0; });
  for (const LuminanceMethod method : kMethods)
    expect_all(estimate_luminance(display, luminance, samples_of(display, 40), with(method, display)), 2,
               1e-6, name_of(method));
}

TEST(GlobalLuminance, OfALogarithmicRampFollowsTheRamp) {
  // ln L = X: every cell's rays have their own middle on average, so accumulation finds x_j; a perceived
  // image mixes rays on both sides of the observer evenly, which raises its logarithm a little and alike
  // everywhere.
  const ProjectorDisplay display = small_projectors(48, 160, 4);
  const auto luminance =
      luminance_by(display, [&](const Ray& ray) { return std::exp(display.position(ray).x_m); });
  const ObserverSamples samples = samples_of(display, 20);
  for (const LuminanceMethod method : {LuminanceMethod::kAccumulative, LuminanceMethod::kSpread}) {
    LuminanceOptions options = with(method, display);
    options.average.epsilon = 1e-9;
    const GlobalLuminance estimate = estimate_luminance(display, luminance, samples, options);
    for (int j = 0; j < samples.size(); ++j)
      EXPECT_NEAR(estimate.ln_luminance[static_cast<std::size_t>(j)], samples.position(j).x_m, 0.02)
          << name_of(method);
  }
}

TEST(GlobalLuminance, StepOfTheViewsOfAMultiViewDisplayIsExact) {
  const MultiViewDisplay display({.views = 6, .width = 12, .height = 5});
  const auto luminance = luminance_by(display, [](const Ray& ray) { return std::pow(10.0, ray.image - 2); });
  const ObserverSamples views = samples_of(display, 6);
  for (const LuminanceMethod method : kMethods) {
    if (method == LuminanceMethod::kAll) continue;
    const GlobalLuminance estimate = estimate_luminance(display, luminance, views, with(method, display));
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(estimate.ln_luminance[static_cast<std::size_t>(i)], std::log(10.0) * (i - 2), 1e-6)
          << name_of(method);
  }
}

TEST(GlobalLuminance, OfASmoothedSampleIsTheWeightedAverageOfEquationFour) {
  // One ray a view: l_j = ln L_j, n_j = 1.
  const MultiViewDisplay display({.views = 3, .width = 1, .height = 1});
  const auto luminance =
      luminance_by(display, [](const Ray& ray) { return std::exp(4.0 * ray.image * ray.image); });
  LuminanceOptions options = with(LuminanceMethod::kAccumulative, display);
  options.smoothed = true;
  const GlobalLuminance estimate = estimate_luminance(display, luminance, samples_of(display, 3), options);
  EXPECT_NEAR(estimate.ln_luminance[0], (0 + 0.5 * 4) / 1.5, 1e-6);
  EXPECT_NEAR(estimate.ln_luminance[1], (4 + 0.5 * 0 + 0.5 * 16) / 2, 1e-6);
  EXPECT_NEAR(estimate.ln_luminance[2], (16 + 0.5 * 4) / 1.5, 1e-6);
}

TEST(GlobalLuminance, FillsUndefinedSamplesLinearlyAndSaysWhich) {
  const MultiViewDisplay display({.views = 6, .width = 2, .height = 2});
  const double levels[] = {0, 1, 0, 0, std::exp(3.0), 0};
  const auto luminance = luminance_by(display, [&](const Ray& ray) { return levels[ray.image]; });
  const GlobalLuminance estimate = estimate_luminance(display, luminance, samples_of(display, 6),
                                                      with(LuminanceMethod::kAccumulative, display));
  const double expected[] = {0, 0, 1, 2, 3, 3};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(estimate.ln_luminance[i], expected[i], 1e-6);
    EXPECT_EQ(estimate.defined[i], levels[i] > 0);
  }
  EXPECT_EQ(estimate.undefined(), 4);
}

TEST(GlobalLuminance, BetweenSamplesIsLinearInTheLogarithmAndConstantBeyondTheEnds) {
  const GlobalLuminance line{{2, 1, 0, 2, 0, 0}, {1, 3}, {1, 1}};
  EXPECT_NEAR(*line.ln_at({1, 0}), 2, 1e-12);
  EXPECT_NEAR(*line.ln_at({0.75, 0}), 1.5, 1e-12);
  EXPECT_EQ(*line.ln_at({-100, 0}), 1);
  EXPECT_EQ(*line.ln_at({1e9, 0}), 3);
  const GlobalLuminance plane{{2, 2, 0, 2, 0, 2}, {0, 1, 2, 3}, {1, 1, 1, 1}};
  EXPECT_NEAR(*plane.ln_at({1, 1}), 1.5, 1e-12);
  EXPECT_NEAR(*plane.ln_at({0.5, 1.5}), 2, 1e-12);
}

TEST(GlobalLuminance, RaysBeyondTheObserversRangeCountForAllOnly) {
  const ProjectorDisplay display = small_projectors();
  // Bright where the ray passes the range, 1 cd/m² inside.
  const auto luminance = luminance_by(
      display, [&](const Ray& ray) { return std::abs(display.position(ray).x_m) > 5 ? 1e6 : 1.0; });
  const ObserverSamples samples = samples_of(display, 40);
  expect_all(estimate_luminance(display, luminance, samples, with(LuminanceMethod::kAccumulative, display)),
             1, 1e-6, "accumulative");
  EXPECT_GT(
      estimate_luminance(display, luminance, samples, with(LuminanceMethod::kAll, display)).ln_luminance[0],
      1);
}

TEST(GlobalLuminance, BruteForceIsNeverBelowNormalisedSpreadAndEqualWhereNeighboursAgree) {
  // The paper's conjecture: the logarithm of a mean is at least the mean of logarithms (Jensen), whatever the
  // rays are.
  const ProjectorDisplay display = small_projectors(16);
  const ObserverSamples samples = samples_of(display, 60);
  const auto gaps = [&](const RayValues<float>& luminance) {
    const auto brute =
        estimate_luminance(display, luminance, samples, with(LuminanceMethod::kBruteForce, display));
    const auto spread =
        estimate_luminance(display, luminance, samples, with(LuminanceMethod::kSpread, display));
    std::vector<double> gap;
    for (std::size_t i = 0; i < brute.ln_luminance.size(); ++i)
      gap.push_back(brute.ln_luminance[i] - spread.ln_luminance[i]);
    return gap;
  };
  for (const double gap : gaps(random_luminance(display, -2, 3))) EXPECT_GT(gap, 0.1);
  const auto same_for_all_projectors =
      luminance_by(display, [](const Ray& ray) { return std::exp(0.3 * ray.u - 0.5 * ray.v); });
  for (const double gap : gaps(same_for_all_projectors)) EXPECT_NEAR(gap, 0, 1e-6);
}

TEST(GlobalLuminance, BlackRaysCanLiftSpreadAboveBruteForce) {
  // What the threshold leaves out breaks the inequality: a perceived mixture of black and bright counts as
  // dimmer, the bright ray alone does not.
  const ProjectorDisplay display = small_projectors(16);
  const auto luminance =
      luminance_by(display, [](const Ray& ray) { return ray.image % 2 == 0 ? 100.0 : 0.0; });
  const ObserverSamples samples = samples_of(display, 30);
  const auto brute =
      estimate_luminance(display, luminance, samples, with(LuminanceMethod::kBruteForce, display));
  const auto spread =
      estimate_luminance(display, luminance, samples, with(LuminanceMethod::kSpread, display));
  for (std::size_t i = 0; i < 30; ++i) EXPECT_LT(brute.ln_luminance[i], spread.ln_luminance[i]);
}

/// Every method and display against the definitions by the letter.
void expect_literal(const RayDisplay& display, const ObserverSamples& samples, const char* name) {
  for (const double black : {0.0, 0.3}) {
    const auto luminance = random_luminance(display, -3, 4, black);
    for (const LuminanceMethod method : kMethods)
      for (const bool variant : {false, true}) {
        LuminanceOptions options = with(method, display);
        options.pinhole = {31, 13};
        options.smoothed = variant && method == LuminanceMethod::kAccumulative;
        options.normalised_spread = !variant;
        if (variant) options.average.rule = LogAverageOptions::Rule::kOffset;
        const auto fast = estimate_luminance(display, luminance, samples, options);
        const auto literal = estimate_luminance_literally(display, luminance, samples, options);
        ASSERT_EQ(fast.defined, literal.defined) << name << ' ' << name_of(method);
        for (std::size_t i = 0; i < fast.ln_luminance.size(); ++i)
          EXPECT_NEAR(fast.ln_luminance[i], literal.ln_luminance[i], 3e-6) << name << ' ' << name_of(method);
      }
  }
}

TEST(GlobalLuminance, IsThatOfTheLiteralDefinitionsOnEveryDisplay) {
  const ProjectorDisplay projectors = small_projectors(7, 23, 11);
  expect_literal(projectors, samples_of(projectors, 17), "projectors");
  const ProjectorDisplay arc(
      {.projectors = 9, .width = 20, .height = 10, .layout = ProjectorDisplayOptions::Layout::kArc});
  expect_literal(arc, samples_of(arc, 17), "arc");
  const MultiViewDisplay views({.views = 5, .width = 16, .height = 9});
  expect_literal(views, samples_of(views, 5), "views");
  const MultiViewDisplay interleaved({.views = 5, .width = 40, .height = 9, .interleaved = true});
  expect_literal(interleaved, samples_of(interleaved, 5), "interleaved");
  const LensArrayDisplay lenses({.width = 96, .height = 12, .lenses_across = 12});
  expect_literal(lenses, samples_of(lenses, 16), "lenticular");
  const LensArrayDisplay slanted({.width = 60, .height = 8, .lenses_across = 10, .slant_lenses = 1.5});
  expect_literal(slanted, samples_of(slanted, 12), "slanted");
  const LensArrayDisplay full({.kind = Kind::kFullParallax,
                               .space = kPlane,
                               .width = 64,
                               .height = 36,
                               .lenses_across = 8,
                               .lenses_down = 6});
  expect_literal(full, samples_of(full, 5, 3), "full parallax");
}

TEST(GlobalLuminance, OfAFullParallaxDisplayFollowsHeightToo) {
  const LensArrayDisplay display({.kind = Kind::kFullParallax,
                                  .space = kPlane,
                                  .width = 80,
                                  .height = 60,
                                  .lenses_across = 10,
                                  .lenses_down = 10});
  const auto luminance = luminance_by(display, [&](const Ray& ray) {
    const ObserverPosition at = display.position(ray);
    return std::exp(2 * at.x_m - 7 * at.y_m);
  });
  const ObserverSamples samples = samples_of(display, 8, 6);
  const auto estimate =
      estimate_luminance(display, luminance, samples, with(LuminanceMethod::kAccumulative, display));
  for (int j = 0; j < samples.size(); ++j)
    EXPECT_NEAR(estimate.ln_luminance[static_cast<std::size_t>(j)],
                2 * samples.position(j).x_m - 7 * samples.position(j).y_m, 1e-5);
}

TEST(GlobalLuminance, IsTheSameForAnyNumberOfThreads) {
  const ProjectorDisplay display = small_projectors(24, 80, 30);
  const auto luminance = random_luminance(display, -3, 4, 0.2);
  for (const LuminanceMethod method : kMethods) {
    LuminanceOptions options = with(method, display);
    const auto one = estimate_luminance(display, luminance, samples_of(display, 100), options);
    options.threads = 3;
    EXPECT_EQ(estimate_luminance(display, luminance, samples_of(display, 100), options).ln_luminance,
              one.ln_luminance);
  }
}

TEST(GlobalLuminance, SaysInASentenceWhatIsWrong) {
  const ProjectorDisplay display = small_projectors();
  const ObserverSamples samples = samples_of(display, 10);
  EXPECT_THROW(estimate_luminance(display, RayValues<float>({1, 2, 3}), samples, {}), InputError);
  const auto luminance = luminance_by(display, [](const Ray&) { return 1; });
  EXPECT_THROW(
      estimate_luminance(display, luminance, samples, {.method = LuminanceMethod::kAll, .smoothed = true}),
      InputError);
  EXPECT_THROW(estimate_luminance(display, luminance, samples, {.pinhole = {0, 4}}), InputError);
  EXPECT_THROW(luminance_method_named("fast"), InputError);
  EXPECT_EQ(luminance_method_named("spread"), LuminanceMethod::kSpread);
}

}  // namespace
}  // namespace plenolab
