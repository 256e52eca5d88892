#include <gtest/gtest.h>

#include <cmath>

#include "core/synthesis/synthesizer.h"
#include "naive_synthesis.h"
#include "test_fields.h"

namespace plenolab {
namespace {

using namespace testing_support;

/// Decisions nearer to their threshold than this may differ between float and double.
constexpr double kTooClose = 2e-4;

/// Compares with the naive synthesis; pixels with a decision too close to call are left out, at most `share`
/// of all.
void expect_like_naive(const LightField& field, CameraPosition at, const SynthesisOptions& options,
                       double share) {
  const auto naive = naive_synthesis(field, at, options);
  const auto view = synthesize(field, at, options);
  std::size_t left_out = 0;
  for (int y = 0; y < naive.height(); ++y)
    for (int x = 0; x < naive.width(); ++x) {
      const NaivePixel& expected = naive.at(x, y);
      if (expected.margin < kTooClose) {
        ++left_out;
        continue;
      }
      ASSERT_EQ(view.visible_views.at(x, y), expected.visible) << x << ", " << y;
      ASSERT_EQ(view.unseen.at(x, y) != 0, expected.unseen) << x << ", " << y;
      ASSERT_EQ(view.restored.at(x, y) != 0, expected.restored) << x << ", " << y;
      const Rgb colour = view.image.at(x, y);
      ASSERT_NEAR(colour.r, expected.r, 3e-3) << x << ", " << y << " margin " << expected.margin;
      ASSERT_NEAR(colour.g, expected.g, 3e-3) << x << ", " << y;
      ASSERT_NEAR(colour.b, expected.b, 3e-3) << x << ", " << y;
    }
  EXPECT_LE(static_cast<double>(left_out), share * static_cast<double>(naive.size()));
}

void expect_like_naive_everywhere(const LightField& field, double share) {
  for (CameraPosition at : {CameraPosition{0.5, 0.5}, CameraPosition{0.21, 0.87}, CameraPosition{1, 0.35},
                            CameraPosition{0, 0}, CameraPosition{0.6, 1}})
    for (double step : {0.5, 1.0, 3.0}) {
      SynthesisOptions options;
      options.step_px = step;
      expect_like_naive(field, at, options, share);
    }
}

TEST(Synthesis, AgreesWithTheNaiveOneOnSmoothSurfacesWithSteps) {
  expect_like_naive_everywhere(stepped_field(grid_of(2, 2, 37, 29), 9, 0, 21), 0.1);
}

TEST(Synthesis, AgreesWithTheNaiveOneWithOutliers) {
  expect_like_naive_everywhere(stepped_field(grid_of(2, 2, 37, 29), 9, 0.03f, 22), 0.1);
}

TEST(Synthesis, AgreesWithTheNaiveOneOnNoiseAndUnequalSpacing) {
  expect_like_naive_everywhere(random_field(grid_of(2, 2, 31, 23, 0.6), 6, 23), 0.1);
}

TEST(Synthesis, AgreesWithTheNaiveOneOnGentleNoiseWhereRuleTwoPassesOften) {
  expect_like_naive_everywhere(random_field(grid_of(2, 2, 31, 23, 1.7), 1.3f, 24), 0.1);
}

TEST(Synthesis, AgreesWithTheNaiveOneInLargerGridsAndOtherSettings) {
  const LightField field = stepped_field(grid_of(3, 2, 33, 27), 7, 0.01f, 25);
  for (BorderWeight weight : {BorderWeight::kPrinted, BorderWeight::kLinearGradient, BorderWeight::kNone})
    for (bool restore : {true, false}) {
      SynthesisOptions options;
      options.border_weight = weight;
      options.restore = restore;
      options.border_fraction = 0.3;
      options.border_delta = 0.05;
      options.occlusion_margin_px = 0.7;
      options.disocclusion_px = 0.6;
      expect_like_naive(field, {1.3, 0.4}, options, 0.1);
    }
}

TEST(Synthesis, AgreesWithTheNaiveOneInGridsOfOneRowOrColumn) {
  expect_like_naive(stepped_field(grid_of(3, 1, 30, 20), 6, 0.01f, 26), {1.4, 0}, {}, 0.1);
  expect_like_naive(stepped_field(grid_of(1, 3, 30, 20), 6, 0.01f, 27), {0, 0.4}, {}, 0.1);
}

}  // namespace
}  // namespace plenolab
