#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "experiments/reproduce/claims/appearance_borders.h"
#include "experiments/reproduce/claims/appearance_floor.h"
#include "experiments/reproduce/claims/appearance_measures.h"
#include "stimuli/render.h"

namespace plenolab {
namespace {

DisplayImage even(int width, int height, float value) {
  return DisplayImage(width, height, Rgb{value, value, value});
}

/// A dark image with bright squares of 3 × 3 px at the given left upper corners.
std::array<DisplayImage, 2> squares(const std::vector<std::pair<int, int>>& corners) {
  DisplayImage image = even(40, 30, 0.1f);
  for (const auto& [left, top] : corners)
    for (int y = top; y < top + 3; ++y)
      for (int x = left; x < left + 3; ++x) image.at(x, y) = {0.7f, 0.7f, 0.7f};
  return {image, image};
}

TwinView even_twin(float synthesised, float truth) {
  TwinView view;
  view.synthesised = {even(48, 32, synthesised), even(48, 32, synthesised)};
  view.truth = {even(48, 32, truth), even(48, 32, truth)};
  view.disparity = DisparityMap(48, 32, 3);
  view.views = Plane<std::uint8_t>(48, 32, 15);
  view.valid = Mask(48, 32, 1);
  return view;
}

constexpr Window kAll{0, 0, 40, 30};

TEST(ClaimsAppearance, CountsSeparateSpotsOnceAndTouchingOnesTogether) {
  EXPECT_EQ(count_spots(luma_of(squares({{4, 4}, {20, 4}, {4, 20}, {20, 20}})), kAll, 0.1f), 4);
  EXPECT_EQ(count_spots(luma_of(squares({{4, 4}, {7, 7}})), kAll, 0.1f), 1);
  EXPECT_EQ(count_spots(luma_of(squares({})), kAll, 0.1f), 0);
}

TEST(ClaimsAppearance, DoesNotTakeASingleBrightPixelForASpot) {
  std::array<DisplayImage, 2> images = squares({});
  for (DisplayImage& image : images) image.at(9, 9) = {1, 1, 1};
  EXPECT_EQ(count_spots(luma_of(images), kAll, 0.1f), 0);
}

TEST(ClaimsAppearance, TwoEqualSpotsCorrelateByOneHalfAtTheirDistance) {
  const Plane<float> two = luma_of(squares({{10, 10}, {22, 10}})), one = luma_of(squares({{10, 10}}));
  EXPECT_NEAR(autocorrelation(two, kAll, 12), 0.5, 1e-6);
  EXPECT_NEAR(autocorrelation(one, kAll, 12), 0, 1e-6);
  EXPECT_NEAR(autocorrelation(one, kAll, 0), 1, 1e-6);
  EXPECT_NEAR(autocorrelation(one, kAll, 1.5), 0.5, 1e-6);  // 3 px wide: (2/3 + 1/3) / 2
}

TEST(ClaimsAppearance, TileErrorsAreTheSquaredDifferenceWhenThereIsNoNoise) {
  const std::vector<TwinView> views{even_twin(0.6f, 0.5f)};
  const TileErrors tiles = tile_errors(views);
  ASSERT_EQ(tiles.error.size(), 24u);
  for (const double error : tiles.error) EXPECT_NEAR(error, 0.01, 1e-6);
  for (const double noise : tiles.noise) EXPECT_EQ(noise, 0);
}

TEST(ClaimsAppearance, IndependentNoiseOfTheTruthDoesNotCountAsError) {
  std::vector<TwinView> views{even_twin(0.5f, 0.5f)};
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < views[0].truth[k].size(); ++i) {
      const float noise = 0.1f * (unit_float(random_u64(k, 1, i)) - 0.5f);
      views[0].truth[k].pixels()[i] += Rgb{noise, noise, noise};
    }
  const TileErrors tiles = tile_errors(views);
  const double variance = 0.01 / 12;
  EXPECT_NEAR(mean(tiles.noise), variance, 0.1 * variance);
  EXPECT_LT(std::abs(mean(tiles.error)), 0.1 * variance);
}

TEST(ClaimsAppearance, TilesThatKeyViewsDoNotAllSeeAreLeftOut) {
  std::vector<TwinView> views{even_twin(0.6f, 0.5f)};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 8; ++x) views[0].valid.at(x, y) = 0;
  EXPECT_EQ(tile_errors(views).error.size(), 20u);
}

TEST(ClaimsAppearance, BorderStepsAreThoseOfTheErrorWhereTheSetOfViewsChanges) {
  std::vector<TwinView> views{even_twin(0.5f, 0.5f)};
  EXPECT_TRUE(squared_border_steps(views).empty());
  for (int y = 0; y < 32; ++y)
    for (int x = 24; x < 48; ++x) {
      views[0].views.at(x, y) = 3;
      for (DisplayImage& image : views[0].synthesised) image.at(x, y) = {0.7f, 0.7f, 0.7f};
    }
  const std::vector<double> steps = squared_border_steps(views);
  ASSERT_EQ(steps.size(), 16u);
  for (const double step : steps) EXPECT_NEAR(step, 0.04, 1e-6);
}

TEST(ClaimsAppearance, NoOrOneLampGivesNoIntervalThatCouldDecideAClaim) {
  const std::vector<LampCopies> none, one(1), two{{.spots = 1}, {.spots = 4}};
  EXPECT_FALSE(mean_spots(none, 1).has_value());
  EXPECT_FALSE(mean_strength(none, 1).has_value());
  EXPECT_FALSE(mean_spots(one, 1).has_value());
  ASSERT_TRUE(mean_spots(two, 1).has_value());
  EXPECT_EQ(mean_spots(two, 1)->estimate, 2.5);
  EXPECT_LT(mean_spots(two, 1)->low,
            0);  // two values say next to nothing: t of one degree of freedom is 12.7
  EXPECT_GT(mean_spots(two, 1)->high, 5);
  EXPECT_EQ(mean_truth_spots(none), 0);
}

TEST(ClaimsAppearance, ALampHasCopiesIfTheViewShowsMoreSpotsThanTheTruth) {
  const std::vector<LampCopies> one(1), lamps{{.spots = 1, .truth_spots = 1},
                                              {.spots = 2, .truth_spots = 2},
                                              {.spots = 4, .truth_spots = 1},
                                              {.spots = 0, .truth_spots = 1}};
  EXPECT_FALSE(share_with_copies(one).has_value());
  const Interval share = share_with_copies(lamps).value();
  EXPECT_EQ(share.estimate, 0.25);
  EXPECT_LT(share.low, 0.25);
  EXPECT_GT(share.high, 0.5);  // four lamps cannot tell a quarter from most
}

TEST(ClaimsAppearance, ARatioOfErrorsPairsTheTilesThatBothHold) {
  const TileErrors dense{.tile = {0, 2, 3}, .error = {1, 4, 100}, .noise = {0, 0, 0}};
  const TileErrors sparse{.tile = {0, 1, 2}, .error = {4, 100, 16}, .noise = {0, 0, 0}};
  const Interval ratio = root_ratio_interval(dense, sparse, 1);
  EXPECT_NEAR(ratio.estimate, 0.5, 1e-12);
  EXPECT_NEAR(ratio.low, 0.5, 1e-12);
  EXPECT_NEAR(ratio.high, 0.5, 1e-12);
}

TEST(ClaimsAppearance, DrawingRepeatedRowsTogetherWidensTheInterval) {
  std::vector<double> rows;
  for (int block = 0; block < 6; ++block) rows.insert(rows.end(), 20, block);
  const Interval single = mean_interval(rows, 1).value(), blocks = mean_interval(rows, 1, 20).value();
  EXPECT_GT(blocks.high - blocks.low, 2 * (single.high - single.low));
}

TEST(ClaimsAppearance, ProjectsThePointOnTheMiddleRayToTheImageCentre) {
  const Scene scene = floor_probe({});
  const ViewGrid grid{2, 2, 0.3, 0.3, 192, 108, 60};
  const Vec3 ahead = scene.camera.centre_m + 4 * scene.camera.forward;
  const ImagePoint centre = project(scene.camera, grid, {0.5, 0.5}, ahead);
  EXPECT_NEAR(centre.x, 96, 1e-4);
  EXPECT_NEAR(centre.y, 54, 1e-4);
  EXPECT_NEAR(centre.disparity_px, grid.disparity_px(4), 1e-5);
  // One spacing to the right moves the point to the left by its disparity.
  const ImagePoint moved = project(scene.camera, grid, {1.5, 0.5}, ahead);
  EXPECT_NEAR(moved.x, 96 - grid.disparity_px(4), 1e-4);
  EXPECT_NEAR(moved.y, 54, 1e-4);
}

TEST(ClaimsAppearance, TheFloorFillsTheImageAndLampsReflectWhereTheyAreExpected) {
  const Scene scene = floor_probe({.kind = FloorLook::Kind::kMirror});
  const ViewGrid grid{2, 2, 0.3, 0.3, 96, 54, 60};
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  const KeyView<SceneReferred> view = render_view(PreparedScene(scene), grid, {0.5, 0.5}, settings).view;
  for (const float disparity : view.disparity.pixels()) EXPECT_GT(disparity, 0);
  for (const FloorLamp& lamp : floor_lamps()) {
    const ImagePoint at = project(scene.camera, grid, {0.5, 0.5}, lamp.reflection_m);
    EXPECT_GT(view.colour.at(static_cast<int>(at.x), static_cast<int>(at.y)).g, 500);
  }
}

TEST(ClaimsAppearance, ProbesWithDifferentContentsHaveDifferentVariants) {
  const std::string flat = floor_probe({.kind = FloorLook::Kind::kMirror}).variant;
  EXPECT_NE(flat, floor_probe({.kind = FloorLook::Kind::kMirror, .ripple_slope = 0.02}).variant);
  EXPECT_NE(flat, floor_probe({.kind = FloorLook::Kind::kDiffuse}).variant);
  EXPECT_NE(dust_probe({}).variant, dust_probe({.scattering_per_m = 1}).variant);
  EXPECT_NE(dust_probe({}).variant, dust_probe({.post = true}).variant);
}

}  // namespace
}  // namespace plenolab
