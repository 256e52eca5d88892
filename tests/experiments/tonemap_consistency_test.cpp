#include "experiments/tonemap_consistency.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/image/colour.h"
#include "core/synthesis/provenance_maps.h"
#include "tests/core/synthesis/test_fields.h"

namespace plenolab {
namespace {

/// One curve for all frames, plus an offset.
DisplayImage mapped(const SceneImage& hdr, float offset = 0) {
  DisplayImage image(hdr.width(), hdr.height());
  for (std::size_t n = 0; n < image.size(); ++n) {
    const float luma = 0.5f + 0.1f * std::log10(luminance(hdr.pixels()[n])) + offset;
    image.pixels()[n] = {luma, luma, luma};
  }
  return image;
}

double value_of(const ResultTable& table, const std::string& quantity) {
  for (const ResultRow& row : table.rows())
    if (row.quantity == quantity) return row.value;
  ADD_FAILURE() << "no row " << quantity;
  return 0;
}

const ViewGrid kGrid = testing_support::grid_of(2, 2, 64, 40, 1.5);

/// Frames of a textured wall of 6 px disparity, each mapped by one curve plus its offset, from a camera that
/// moves by `step` a frame.
ConsistencyMeter judged(const std::vector<float>& offsets, CameraPosition step,
                        SynthesisOptions options = {}) {
  const Synthesizer synthesizer(testing_support::plane_field(kGrid, 6));
  ConsistencyMeter meter(kGrid, options);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const double n = static_cast<double>(i);
    const ReferenceFrame reference =
        reference_frame(synthesizer, {0.2 + n * step.s, 0.3 + n * step.t}, options);
    meter.add(reference, mapped(reference.hdr, offsets[i]));
  }
  return meter;
}

TEST(ConsistencyMeter, OneCurveForAllFramesIsConsistent) {
  const ResultTable table = judged({0, 0, 0, 0}, {0.1, 0.05}).summary({});
  EXPECT_LT(value_of(table, "frame_change_max"), 5e-5);
  EXPECT_LT(value_of(table, "line_change_rms"), 1e-3);
  EXPECT_GT(value_of(table, "border_pairs"), 50);
}

TEST(ConsistencyMeter, AFrameThatFlashesIsFoundBothWays) {
  const ResultTable table = judged({0, 0.04f, 0.04f, 0.04f}, {0.1, 0.05}).summary({});
  EXPECT_NEAR(value_of(table, "frame_change_max"), 0.04, 2e-4);
  EXPECT_NEAR(value_of(table, "line_change_rms"), 0.04 / std::sqrt(3), 3e-3);
  EXPECT_NEAR(value_of(table, "motion_luma_step_max"), 0.04, 5e-3);
}

TEST(ConsistencyMeter, MotionIsFollowedAlongRowsAndColumnsAndOnAFixedScreen) {
  constexpr double kPixels = 64 * 40;
  EXPECT_GT(value_of(judged({0, 0}, {0.6, 0}).summary({}), "line_pixels"), 0.85 * kPixels);
  // 0.6 · 6 px · 1.5 = 5.4 of 40 rows leave the view.
  EXPECT_GT(value_of(judged({0, 0}, {0, 0.6}).summary({}), "line_pixels"), 0.75 * kPixels);
  SynthesisOptions screen;
  screen.camera = CameraKind::kFixedScreen;
  screen.screen_depth_m = kGrid.disparity_px(1) / 6;  // where the wall is: nothing moves
  EXPECT_GT(value_of(judged({0, 0}, {0.6, 0.6}, screen).summary({}), "line_pixels"), 0.95 * kPixels);
}

TEST(ConsistencyMeter, AStepThatOnlyMappedFramesHaveAtBordersOfVisibilityIsExcess) {
  const Synthesizer synthesizer(testing_support::plane_field(kGrid, 6));
  const ReferenceFrame reference = reference_frame(synthesizer, {0.4, 0.5}, {});
  const auto excess_with = [&](float step) {
    DisplayImage image = mapped(reference.hdr);
    for (std::size_t n = 0; n < image.size(); ++n)
      if (reference.contributors.pixels()[n] != 0b1111)
        image.pixels()[n] = image.pixels()[n] + Rgb{step, step, step};
    ConsistencyMeter meter(kGrid, {});
    meter.add(reference, image);
    return value_of(meter.summary({}), "border_excess");
  };
  EXPECT_NEAR(excess_with(0), 1, 0.01);
  EXPECT_GT(excess_with(0.1f), 5);
}

TEST(ConsistencyMeter, AFrameWithNothingInCommonHasNoChange) {
  ConsistencyMeter meter(kGrid, {});
  const Plane<std::uint8_t> nobody(64, 40);
  ResultTable rows;
  for (const float level : {1.f, 100.f}) {
    const SceneImage hdr(64, 40, Rgb{level, level, level});
    add_consistency_rows(rows, meter.add({{0.5, 0.5}, hdr, DisparityMap(64, 40), nobody}, mapped(hdr)), {});
  }
  EXPECT_TRUE(rows.empty());
  const ResultTable summary = meter.summary({});
  for (const ResultRow& row : summary.rows())
    EXPECT_TRUE(!row.quantity.starts_with("line") && !row.quantity.starts_with("frame")) << row.quantity;
}

TEST(ProvenanceMaps, DisparityIsThatOfTheSurfaceAndRestoredPixelsHaveNoContributors) {
  SynthesisOptions options;
  options.record_provenance = true;
  const auto view = synthesize(testing_support::plane_field(kGrid, 6), {0.5, 0.5}, options);
  const DisparityMap disparity = shown_disparity(view.provenance);
  const Plane<std::uint8_t> sets = contributing_views(view.provenance);
  EXPECT_NEAR(disparity.at(32, 20), 6, 1e-5);
  EXPECT_EQ(sets.at(32, 20), 0b1111);
  for (std::size_t n = 0; n < sets.size(); ++n) {
    const int views = std::popcount(sets.pixels()[n]);
    EXPECT_LE(views, view.visible_views.pixels()[n]);
  }
  Plane<PixelProvenance> restored(1, 1);
  restored.at(0, 0)[0] = {.state = CorrespondenceState::kRestored, .disparity_px = 2, .weight = 1};
  EXPECT_EQ(contributing_views(restored).at(0, 0), 0);
  EXPECT_EQ(shown_disparity(restored).at(0, 0), 2);
}

}  // namespace
}  // namespace plenolab
