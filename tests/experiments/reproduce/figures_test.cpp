#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/reproduce/figure_epi.h"
#include "experiments/reproduce/figure_overview.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"
#include "experiments/reproduce/figure_restoration.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {
namespace {

Plane<float> single_weight(int width, int height, int x, int y) {
  Plane<float> weights(width, height);
  weights.at(x, y) = 1;
  return weights;
}

SceneImage constant_image(int width, int height, float value) {
  SceneImage image(width, height);
  std::fill(image.pixels().begin(), image.pixels().end(), Rgb{value, value, value});
  return image;
}

TEST(DensestBox, HoldsTheOnlyWeightAndLiesInTheImage) {
  for (const auto& [x, y] : {std::pair{0, 0}, {19, 11}, {7, 5}}) {
    const PixelBox box = densest_box(single_weight(20, 12, x, y), 4);
    EXPECT_TRUE(x >= box.x && x < box.x + 4 && y >= box.y && y < box.y + 4);
    EXPECT_TRUE(box.x >= 0 && box.y >= 0 && box.x + 4 <= 20 && box.y + 4 <= 12);
  }
}

TEST(DensestBox, WithoutWeightsIsTheMiddle) {
  EXPECT_EQ(densest_box(Plane<float>(20, 12), 4), (PixelBox{8, 4, 4, 4}));
}

TEST(DensestRow, IsTheRowOfTheWeightInsideTheBoxOnly) {
  EXPECT_EQ(densest_row(single_weight(20, 12, 5, 6), {4, 4, 4, 4}), 6);
  EXPECT_EQ(densest_row(single_weight(20, 12, 5, 1), {4, 4, 4, 4}), 6);
}

TEST(BoxMean, KeepsAConstantUpToTheBorder) {
  const Plane<float> means = box_mean(Plane<float>(7, 5, 3.0f), 2);
  for (const float mean : means.pixels()) EXPECT_FLOAT_EQ(mean, 3.0f);
}

TEST(Magnify, RepeatsPixels) {
  DisplayImage image(2, 1);
  image.at(1, 0) = {1, 0.5f, 0};
  const DisplayImage large = magnify(image, 4);
  EXPECT_EQ(large.width(), 8);
  EXPECT_EQ(large.height(), 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(large.at(x, y), image.at(x / 4, 0));
}

TEST(MarkBox, LeavesWhatIsInsideUntouchedUnlessTheImageEnds) {
  const DisplayImage marked = mark_box(DisplayImage(9, 9), {3, 3, 3, 3});
  for (int y = 3; y < 6; ++y)
    for (int x = 3; x < 6; ++x) EXPECT_EQ(marked.at(x, y), Rgb{});
  EXPECT_EQ(marked.at(2, 2), kCropMark);
  EXPECT_EQ(marked.at(6, 6), kCropMark);
  const DisplayImage whole = mark_box(DisplayImage(4, 4), {0, 0, 4, 4});
  EXPECT_EQ(whole.at(0, 0), kCropMark);
  EXPECT_EQ(whole.at(3, 3), kCropMark);
}

TEST(FigureExposure, IgnoresTheBrightestTwentieth) {
  SceneImage image = constant_image(10, 10, 2);
  image.at(0, 0) = image.at(5, 5) = {1e6f, 1e6f, 1e6f};
  EXPECT_NEAR(figure_exposure(image), 0.5f, 1e-5f);
  EXPECT_EQ(figure_exposure(constant_image(4, 4, 0)), 1.0f);
}

TEST(CropExposure, IsNeverDarkerThanThatOfTheWholeView) {
  SceneImage image = constant_image(40, 40, 1);
  image.at(1, 1) = {50, 50, 50};
  EXPECT_EQ(crop_exposure(image, {0, 0, 4, 4}), figure_exposure(image));
}

TEST(CellPositions, LieOnTheGridAndCoverEveryCell) {
  const ViewGrid grid{.columns = 4, .rows = 3};
  EXPECT_EQ(cell_positions(grid, std::array{CameraPosition{0.5, 0.5}}).size(), 6u);
  EXPECT_EQ(cell_positions(grid, offsets_on_rows()).size(), 9u);
  for (const CameraPosition& p : cell_positions(grid, offsets_inside_cells())) EXPECT_TRUE(grid.contains(p));
}

TEST(CellPositions, OfASingleViewAreThatView) {
  const auto positions = cell_positions(ViewGrid{}, offsets_inside_cells());
  ASSERT_EQ(positions.size(), 1u);
  EXPECT_EQ(positions[0], (CameraPosition{0, 0}));
}

constexpr int kSize = 24;

/// 2 × 1 views of a far plane; the right view is brighter by `gain` in its right half.
LightField two_views(float gain) {
  const ViewGrid grid{.columns = 2, .rows = 1, .width = kSize, .height = kSize};
  std::vector<KeyView<SceneReferred>> views;
  for (int v = 0; v < 2; ++v) {
    KeyView<SceneReferred> view{constant_image(kSize, kSize, 1), DisparityMap(kSize, kSize)};
    for (int y = 0; y < kSize; ++y)
      for (int x = kSize / 2; v == 1 && x < kSize; ++x) view.colour.at(x, y) = Rgb{0.1f, 0.1f, 0.1f} * gain;
    views.push_back(std::move(view));
  }
  return LightField::from_views(grid, RadianceUnit::kRelative, "two views", std::move(views));
}

TEST(DisagreementOfViews, IsZeroWhereKeyViewsAgreeAndFoundWhereTheyDoNot) {
  const LightField field = two_views(5);
  const Place place = find_place(Synthesizer(field), cell_positions(field.grid(), offsets_on_rows()), 1,
                                 disagreement_of_views(field));
  EXPECT_EQ(place.view.position, (CameraPosition{0.5, 0}));
  EXPECT_NEAR(place.effect.at(4, 12), 0, 1e-9);
  // Two equal weights: the variance is the square of half the difference of encoded luma.
  const double half = (1 - std::pow(0.5, 1 / 2.2)) / 2;
  EXPECT_NEAR(place.effect.at(18, 12), half * half, 1e-4);
  EXPECT_GT(place.sum, 0);
}

TEST(JumpAtVisibilityBorders, NeedsABorder) {
  const LightField field = two_views(5);
  const Place place = find_place(Synthesizer(field), cell_positions(field.grid(), offsets_on_rows()), 1,
                                 jump_at_visibility_borders(field));
  EXPECT_EQ(place.sum, 0);
}

TEST(WarpedKeyViews, OfAFarPlaneAreTheKeyViewsThemselves) {
  const LightField field = two_views(5);
  SynthesisOptions options;
  options.record_provenance = true;
  const auto view = Synthesizer(field).synthesize({0.5, 0}, options);
  const auto warped = warp_key_views(view, field);
  ASSERT_EQ(warped.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v)
    for (int x = 1; x + 1 < kSize; ++x)
      EXPECT_NEAR(std::pow(warped[v].encoded.at(x, 9).r, 2.2),
                  field.view(view.views[v].column, 0)->colour.at(x, 9).r, 1e-4);
}

TEST(Pictures, OfEqualViewsShowNoErrorAndShareOneSize) {
  const SceneImage image = constant_image(48, 32, 2);
  ReproductionResult result;
  const PictureNumbers numbers = add_pictures(result,
                                              {.what = "Test",
                                               .truth = &image,
                                               .synthesised = {{"Synthesised", &image}},
                                               .maps = {},
                                               .box = {4, 4, 16, 16},
                                               .cut_row = 7,
                                               .note = {}},
                                              {{"scene", std::string("test")}}, 1);
  EXPECT_TRUE(std::isinf(numbers.whole[0].psnr_db));
  EXPECT_EQ(numbers.box[0].visible_share, 0);
  ASSERT_EQ(result.blocks.size(), 2u);
  const auto& crop = std::get<ImageComparison>(result.blocks[1]);
  ASSERT_EQ(crop.images.size(), 3u);
  for (const ReportImage& shown : crop.images) EXPECT_EQ(shown.image.width(), 64);
}

TEST(MaskedRows, CountOnlyPixelsOfTheMaskAndSkipAnEmptyOne) {
  const SceneImage truth = constant_image(8, 8, 1);
  SceneImage test = truth;
  test.at(0, 0) = Rgb{};
  Mask mask(8, 8);
  ReproductionResult result;
  EXPECT_FALSE(add_masked_rows(result, test, truth, mask, "none", {}).has_value());
  EXPECT_TRUE(result.rows.empty());
  mask.at(0, 0) = mask.at(1, 0) = 1;
  const auto numbers = add_masked_rows(result, test, truth, mask, "two", {});
  ASSERT_TRUE(numbers.has_value());
  EXPECT_EQ(numbers->pixels, 2u);
  EXPECT_EQ(numbers->visible_share, 0.5);
  EXPECT_EQ(numbers->truth_spread, 0);
}

TEST(SmoothedDifference, KeepsACommonOffsetAndAveragesGlitter) {
  const SceneImage truth = constant_image(12, 12, 0.25f), brighter = constant_image(12, 12, 0.5f);
  SceneImage glitter = truth;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; x += 3) glitter.at(x, y) = Rgb{1, 1, 1};
  const auto offset = static_cast<float>(std::pow(0.5, 1 / 2.2) - std::pow(0.25, 1 / 2.2));
  EXPECT_NEAR(smoothed_squared_difference(brighter, truth, 1, 4).at(6, 6), offset * offset, 1e-4f);
  const auto step = static_cast<float>(1 - std::pow(0.25, 1 / 2.2));
  EXPECT_NEAR(smoothed_squared_difference(glitter, truth, 1, 4).at(6, 6), step * step / 9, 1e-4f);
}

TEST(WithoutNoise, LeavesNothingOfNoiseAloneAndEverythingWithoutNoise) {
  // Variances in units of a key view's: 1 - 1/4 at a key view, 1/2 + 1/4 midway.
  EXPECT_NEAR(without_noise(std::sqrt(0.75), std::sqrt(0.75)), 0, 1e-6);
  EXPECT_DOUBLE_EQ(without_noise(0.2, 0), 0.2);
  EXPECT_EQ(without_noise(0.1, 0.2), 0);
  EXPECT_NEAR(without_noise(0.5, 0.3), 0.4, 1e-12);
}

/// Frames over two spacings, wrong by an amount that grows from key views to the middle, or by a constant.
EpiPair epi_with_error(double t, bool grows) {
  EpiPair epi;
  epi.positions = straight_path({0, t}, {2, t}, kEpiFrames);
  epi.truth = epi.synthesised = constant_image(16, kEpiFrames, 0.25f);
  epi.at_s = 0.5;
  for (int frame = 0; frame < kEpiFrames; ++frame) {
    const double s = epi.positions[static_cast<std::size_t>(frame)].s;
    const auto error = static_cast<float>(grows ? std::abs(s - std::round(s)) : 0.3);
    for (int x = 0; x < 16; ++x) epi.synthesised.at(x, frame) += Rgb{error, error, error};
  }
  return epi;
}

EpiNumbers numbers_of(const EpiPair& epi) {
  return measure_epi(epi, {0, 0, 16, 16}, 1);
}

TEST(EpiNumbers, TellAnErrorThatFadesTowardsKeyViewsFromOneThatDoesNot) {
  EXPECT_TRUE(fades(numbers_of(epi_with_error(0, true))));
  EXPECT_FALSE(fades(numbers_of(epi_with_error(0, false))));
}

TEST(EpiNumbers, KnowTheNoiseOnlyIfTheMotionPassesThroughKeyViews) {
  const EpiNumbers through = numbers_of(epi_with_error(0, true));
  ASSERT_TRUE(through.rms_noise.has_value());
  EXPECT_NEAR(*through.rms_noise, 0, 1e-6);
  EXPECT_NEAR(*through.rms_between_without_noise, through.rms_between, 1e-6);
  EXPECT_FALSE(numbers_of(epi_with_error(0.5, true)).rms_noise.has_value());
}

/// A view that both key views see but for its lower half, too dark by `error` in its left upper quarter.
NovelView<SceneReferred> view_with_error(float error) {
  NovelView<SceneReferred> view;
  view.image = constant_image(32, 32, 0.25f);
  view.views.resize(2);
  view.visible_views = Plane<std::uint8_t>(32, 32, 2);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      if (y >= 16) view.visible_views.at(x, y) = 1;
      if (x < 16 && y < 16) view.image.at(x, y) = Rgb{1, 1, 1} * (0.25f - error);
    }
  return view;
}

TEST(Overview, LooksAtSquaresThatAllKeyViewsSeeByHalf) {
  NovelView<SceneReferred> view = view_with_error(0);
  EXPECT_EQ(eligible_squares(view, 16), (std::vector<PixelBox>{{0, 0, 16, 16}, {16, 0, 16, 16}}));
  for (int x = 0; x < 16; ++x) view.visible_views.at(x, 0) = 1;
  EXPECT_EQ(eligible_squares(view, 16).size(), 2u);
  for (int x = 0; x < 16; ++x)
    for (int y = 1; y < 9; ++y) view.visible_views.at(x, y) = 1;
  EXPECT_EQ(eligible_squares(view, 16).size(), 1u);
  EXPECT_TRUE(eligible_squares(view, 33).empty());
}

TEST(Overview, SetsTheEnlargedPartBesideAllOthers) {
  const NovelView<SceneReferred> view = view_with_error(0.2f);
  const SceneImage truth = constant_image(32, 32, 0.25f);
  const Overview overview = overview_of(view, truth, {0, 0, 16, 16}, nullptr);
  ASSERT_TRUE(overview.rms.has_value());
  EXPECT_EQ(overview.rms->count, 2u);
  EXPECT_EQ(overview.rms->low, 0);
  EXPECT_DOUBLE_EQ(overview.rms->high, overview.rms_of_box);
  EXPECT_DOUBLE_EQ(overview.rms->median, overview.rms_of_box / 2);
  EXPECT_FALSE(overview.fading.has_value());
  EXPECT_NE(overview_text(overview).find("2 squares"), std::string::npos);
}

TEST(Overview, MeasuresFadingInTheMiddleRowWhereverTheEnlargedPartLies) {
  NovelView<SceneReferred> view = view_with_error(0);
  view.visible_views = Plane<std::uint8_t>(32, 32, 2);
  EpiPair epi;
  epi.positions = straight_path({0, 0}, {2, 0}, kEpiFrames);
  epi.truth = epi.synthesised = constant_image(32, kEpiFrames, 0.25f);
  epi.at_s = 0.5;
  for (int frame = 0; frame < kEpiFrames; ++frame) {
    const double s = epi.positions[static_cast<std::size_t>(frame)].s;
    for (int x = 0; x < 32; ++x) {
      // Grows between key views on the left, stays on the right.
      const auto error = static_cast<float>(x < 16 ? 0.01 + 0.4 * std::abs(s - std::round(s)) : 0.1);
      epi.synthesised.at(x, frame) = Rgb{1, 1, 1} * (0.25f - error);
    }
  }
  const Overview overview = overview_of(view, constant_image(32, 32, 0.25f), {0, 0, 16, 16}, &epi);
  ASSERT_TRUE(overview.fading.has_value());
  EXPECT_EQ(overview.fading->count, 2u);
  EXPECT_NEAR(overview.fading->low, 1, 1e-6);
  EXPECT_GT(overview.fading->high, kFadingRatio);
}

TEST(RestoredBeforeBackground, FollowsTheDepthOfTheTruthOnly) {
  Mask restored(3, 1);
  restored.at(0, 0) = restored.at(1, 0) = 1;
  DisparityMap truth(3, 1);
  truth.at(0, 0) = kFarBackground_px;
  truth.at(1, 0) = 2 * kFarBackground_px;
  const Mask mask = restored_before_background(restored, truth);
  EXPECT_EQ(mask.at(0, 0), 1);
  EXPECT_EQ(mask.at(1, 0), 0);
  EXPECT_EQ(mask.at(2, 0), 0);
}

}  // namespace
}  // namespace plenolab
