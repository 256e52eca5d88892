#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/tonemap/claim_tools.h"
#include "experiments/reproduce/tonemap/measures.h"
#include "experiments/reproduce/tonemap/motion_measures.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {

Mapping reinhard(const std::string& variant) {
  return mapping_of("Reinhard " + variant, "reinhard05", variant);
}

/// A view of one surface whose left half one key view sees and whose right half another.
ReferenceFrame halves(int width, int height) {
  ReferenceFrame frame{{0.5, 0.5},
                       SceneImage(width, height),
                       DisparityMap(width, height, 3.0f),
                       Plane<std::uint8_t>(width, height, 1)};
  for (int y = 0; y < height; ++y)
    for (int x = width / 2; x < width; ++x) frame.contributors.at(x, y) = 2;
  return frame;
}

Plane<float> step_of(int width, int height, int at, float size) {
  Plane<float> values(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = at; x < width; ++x) values.at(x, y) = size;
  return values;
}

/// The plane as a mapping shows it that brightens every key view to the right by `rise`.
DisplayLightField rising(const LightField& hdr, float rise) {
  const ViewGrid& grid = hdr.grid();
  std::vector<KeyView<DisplayReferred>> views;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto view = hdr.view(column, row);
      DisplayImage mapped(grid.width, grid.height);
      for (std::size_t n = 0; n < mapped.size(); ++n) {
        const float luma = 0.05f * view->colour.pixels()[n].r + 0.3f + rise * static_cast<float>(column);
        mapped.pixels()[n] = {luma, luma, luma};
      }
      views.push_back({std::move(mapped), view->disparity});
    }
  return DisplayLightField::from_views(grid, hdr.unit(), "rising", std::move(views));
}

TEST(BorderStep, IsTheStepWhereOtherKeyViewsSeeTheSurface) {
  const BorderStep step = border_step(step_of(20, 12, 10, 0.1f), halves(20, 12));
  EXPECT_NEAR(step.rms, 0.1, 1e-6);
  EXPECT_NEAR(step.largest, 0.1, 1e-6);
}

TEST(BorderStep, LeavesOutStepsInsideAnAreaOfTheSameKeyViews) {
  const BorderStep step = border_step(step_of(20, 12, 5, 0.1f), halves(20, 12));
  EXPECT_EQ(step.rms, 0);
  EXPECT_EQ(step.largest, 0);
}

TEST(BorderStep, LeavesOutPixelsBesideAnotherSurface) {
  ReferenceFrame frame = halves(20, 12);
  for (int y = 0; y < 12; ++y) frame.disparity_px.at(11, y) = 9;
  EXPECT_EQ(border_step(step_of(20, 12, 10, 0.1f), frame).largest, 0);
}

TEST(PairChanges, FindTheRiseBetweenNeighboursInItsDirectionOnly) {
  const LightField hdr = plane_field(3);
  const DisplayLightField mapped = rising(hdr, 0.04f);
  const auto across = pair_changes(hdr, mapped, Neighbours::kAcross, 1);
  ASSERT_EQ(across.size(), 6u);
  for (const PairChange& pair : across) EXPECT_NEAR(pair.change.mean, 0.04, 0.004);
  for (const PairChange& pair : pair_changes(hdr, mapped, Neighbours::kDown, 1))
    EXPECT_NEAR(pair.change.mean, 0, 0.004);
  const auto far = pair_changes(hdr, mapped, Neighbours::kAcross, 1, 2);
  ASSERT_EQ(far.size(), 3u);
  EXPECT_NEAR(far[0].change.mean, 0.08, 0.006);
}

TEST(WithOneFit, IsTheVariantForWholeLightFields) {
  EXPECT_EQ(with_one_fit(reinhard("naive+adjusted")).choice.variant.id, "joint");
  EXPECT_FALSE(with_one_fit(reinhard("naive+adjusted")).choice.adjusted);
  EXPECT_EQ(with_one_fit(mapping_of("", "bilateral", "enhanced")).choice.variant.id, "enhanced");
}

TEST(MappingKey, TellsMappingsApartButNotLabels) {
  Mapping a = reinhard("naive"), b = a;
  b.label = "other";
  EXPECT_EQ(a.key(), b.key());
  b.border_weight = BorderWeight::kNone;
  EXPECT_NE(a.key(), b.key());
  EXPECT_NE(a.key(), reinhard("joint").key());
  EXPECT_NE(a.key(), mapping_of("", "reinhard05", "naive", {"b=1"}).key());
}

TEST(RecordMotion, FindsWhereTheLightAppears) {
  const LightField plain = plane_field(3);
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      KeyView<SceneReferred> view = *plain.view(column, row);
      if (column == 2) view.colour.at(24, 16) = {1e9f, 1e9f, 1e9f};
      views.push_back(std::move(view));
    }
  const Synthesizer synthesizer(
      LightField::from_views(plain.grid(), plain.unit(), "light", std::move(views)));
  const RecordedMotion recording =
      record_motion(synthesizer, {.from = {0, 1}, .to = {2, 1}, .frames = 17}, 1);
  ASSERT_EQ(recording.frames.size(), 17u);
  EXPECT_GE(recording.event, 9u);
  EXPECT_LE(recording.event, 16u);
  EXPECT_GT(log_peak(recording.frames.back().hdr), 8);
}

TEST(RecordMotion, AFasterPassTakesEveryFewFrames) {
  const RecordedMotion slow = record_motion(Synthesizer(plane_field(3)), {{0, 1}, {2, 1}, 9}, 1);
  const RecordedMotion fast = faster(slow, 4);
  ASSERT_EQ(fast.frames.size(), 3u);
  EXPECT_EQ(fast.frames[1].position, slow.frames[4].position);
  EXPECT_EQ(fast.motion.frames, 3);
  EXPECT_EQ(faster(slow, 1).frames.size(), slow.frames.size());
}

/// A plane with a pattern so smooth that interpolation reproduces it.
LightField smooth_field() {
  const ViewGrid grid{3, 3, 0.1, 0.1, 48, 32, 60};
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      KeyView<SceneReferred> view{SceneImage(48, 32), DisparityMap(48, 32, 3.0f)};
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
          const auto v = static_cast<float>(2 + std::sin(0.15 * (x + 3 * column)) + 0.02 * (y + 3 * row));
          view.colour.at(x, y) = {v, v, v};
        }
      views.push_back(std::move(view));
    }
  return LightField::from_views(grid, RadianceUnit::kCdM2, "smooth", std::move(views));
}

TEST(MapMotion, OneCurveForAllFramesDoesNotAdaptAndARiseShowsWhole) {
  const LightField field = smooth_field();
  const LightFieldStatistics statistics = measure_light_field(field, 1);
  const RecordedMotion recording = record_motion(Synthesizer(field), {{0, 1}, {2, 1}, 9}, 1);
  const Mapping joint = reinhard("joint");
  const MappedKeyViews views = map_key_views(field, statistics, joint, 1);
  const MappedMotion motion = map_motion(field, statistics, recording, joint, &views, {}, 1);
  ASSERT_EQ(motion.frames.size(), 9u);
  EXPECT_EQ(motion.epi.height(), 9);
  EXPECT_EQ(motion.epi.width(), field.grid().width);
  EXPECT_LT(adaptation_range(motion), 0.004);
  const MappedKeyViews brighter{rising(field, 0.04f), {}, {}, {}};
  const MappedMotion rise = map_motion(field, statistics, recording, joint, &brighter, {}, 1);
  EXPECT_NEAR(adaptation_range(rise), 0.08, 0.008);
  EXPECT_NEAR(largest_step(rise), 0.01, 0.004);
}

TEST(MapMotion, VariantsForFramesMapThemInOrder) {
  const LightField field = smooth_field();
  const LightFieldStatistics statistics = measure_light_field(field, 1);
  const RecordedMotion recording = record_motion(Synthesizer(field), {{0, 1}, {2, 1}, 9}, 1);
  const MappedMotion motion =
      map_motion(field, statistics, recording, reinhard("interpolate-statistics"), nullptr, {}, 1);
  ASSERT_EQ(motion.fits.size(), 9u);
  EXPECT_FALSE(motion.fits[3].empty());
  EXPECT_FALSE(motion.last.empty());
}

TEST(MeanRatio, IsThatOfTheMeansAndNeedsTwoPairs) {
  const std::vector<double> a{1, 3}, b{2, 6}, one{1}, zero{0, 0};
  EXPECT_DOUBLE_EQ(mean_ratio(a, b, 1)->estimate, 0.5);
  EXPECT_DOUBLE_EQ(mean_ratio(a, b, 1)->high, 0.5);
  EXPECT_FALSE(mean_ratio(one, one, 1));
  EXPECT_FALSE(mean_ratio(a, zero, 1));
}

TEST(AddClaim, IsUndecidedWithoutAnInterval) {
  ReproductionResult result;
  add_claim(result, {"A-T0", "nowhere", "Nothing."}, {.explanation = "why"});
  add_claim(result, {"A-T1", "nowhere", "Something."},
            {Interval{1, 0.9, 1.1}, Comparison::kAbove, 0.5, "q", "1", "u", {"scene"}, "why"});
  ASSERT_EQ(result.ledger.size(), 2u);
  EXPECT_EQ(result.ledger[0].verdict.outcome, Outcome::kUndecided);
  EXPECT_EQ(result.ledger[1].verdict.outcome, Outcome::kConfirmed);
  EXPECT_EQ(outcome_words(result), "A-T0: our measurement does not decide it. A-T1: our measurement agrees.");
}

}  // namespace
}  // namespace plenolab
