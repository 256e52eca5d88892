#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "experiments/reproduce/tonemap/bilateral_edges.h"
#include "experiments/reproduce/tonemap/depth_edge_contrast.h"
#include "experiments/reproduce/tonemap/trimming_consistency.h"

namespace plenolab {
namespace {

constexpr int kWidth = 16, kHeight = 8;

/// `left` left of the middle, `right` right of it.
Plane<float> halves(float left, float right) {
  Plane<float> plane(kWidth, kHeight, right);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) plane.at(x, y) = left;
  return plane;
}

DepthEdgeContrast contrast_of(const Plane<float>& log, const Plane<float>& disparity,
                              const Plane<float>& plane, const DepthEdgeOptions& options = {}) {
  return contrast_across_depth_edges(log, disparity, std::array{&plane}, options);
}

TEST(DepthEdgeContrast, CountsOnePairARowAndSumsSignedContrast) {
  const auto contrast = contrast_of(halves(0, 0.3f), halves(9, 2), halves(0, 0.1f));
  EXPECT_EQ(contrast.edges, kHeight);
  EXPECT_NEAR(contrast.input, kHeight * 0.3, 1e-6);
  EXPECT_NEAR(contrast.along[0], kHeight * 0.1, 1e-6);
}

TEST(DepthEdgeContrast, IsNegativeWhereAPlaneReversesTheContrast) {
  EXPECT_LT(contrast_of(halves(0, 0.3f), halves(9, 2), halves(0.2f, 0)).along[0], 0);
}

TEST(DepthEdgeContrast, LeavesOutEdgesOfLuminanceWithoutDepthAndHighContrast) {
  EXPECT_EQ(contrast_of(halves(0, 0.3f), halves(5, 5), halves(0, 0.1f)).edges, 0);
  EXPECT_EQ(contrast_of(halves(0, 0.3f), halves(9, 2), halves(0, 0.1f), {.most_contrast_log10 = 0.2}).edges,
            0);
}

TEST(DepthEdgeContrast, LeavesOutSurfacesNarrowerThanASide) {
  Plane<float> disparity = halves(2, 2), log = halves(0, 0);
  for (int y = 0; y < kHeight; ++y) disparity.at(7, y) = disparity.at(8, y) = 9;
  EXPECT_EQ(contrast_of(log, disparity, log, {.side_px = 3}).edges, 0);
  EXPECT_EQ(contrast_of(log, disparity, log, {.side_px = 2}).edges, 2 * kHeight);
}

TEST(SumContrast, FollowsTheFormulaOfTheOperator) {
  const std::vector<LayerContrast> views{
      {.input = 2, .naive_base = 1, .base = 2, .foreground = 0.5, .edges = 1}};
  const TargetContrast sum = sum_contrast(views, 0.4);
  EXPECT_NEAR(sum.naive, 2 - 0.6, 1e-12);
  EXPECT_NEAR(sum.without, 2 - 1.2, 1e-12);
  EXPECT_NEAR(sum.with, 2 - 1.2 + 0.3, 1e-12);
  EXPECT_NEAR(sum.returned(), 0.5, 1e-12);
}

/// 2 × 1 views of a far plane with six decades of light; rows of the right one have the lower three only.
ToneScene far_scene(int dark_rows) {
  const ViewGrid grid{.columns = 2, .rows = 1, .width = 32, .height = 32};
  std::vector<KeyView<SceneReferred>> views;
  for (int v = 0; v < 2; ++v) {
    KeyView<SceneReferred> view{SceneImage(32, 32), DisparityMap(32, 32)};
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        const double decades = v == 1 && y < dark_rows ? 3 : 6;
        const double place = (x * 32 + y) / 1023.0;  // of its own for each pixel: no bin stands out
        view.colour.at(x, y) = Rgb{1, 1, 1} * static_cast<float>(std::pow(10.0, -2 + decades * place));
      }
    views.push_back(std::move(view));
  }
  const LightField field = LightField::from_views(grid, RadianceUnit::kCdM2, "far", std::move(views));
  return {"far", "Far", field, measure_light_field(field, 1)};
}

TEST(TrimmingConsistency, EqualViewsAddNoChange) {
  const auto run = measure_trimming_consistency(far_scene(0), HistogramCeiling::kPerceptual, std::nullopt, 1);
  ASSERT_EQ(run.pairs.size(), 1u);
  EXPECT_EQ(run.neighbours, 1u);
  EXPECT_EQ(run.pairs[0].pixels, 32 * 32);
  EXPECT_EQ(run.largest_added(), 0);
  EXPECT_TRUE(run.different.empty());
}

TEST(TrimmingConsistency, ADifferentHistogramAddsAChange) {
  const auto run = measure_trimming_consistency(far_scene(20), HistogramCeiling::kPerceptual, 1, 1);
  ASSERT_EQ(run.pairs.size(), 1u);
  EXPECT_GT(run.mean_added(), 0.001);
  EXPECT_TRUE(run.different.empty());  // one pass each
}

TEST(TrimmingConsistency, CountsTheSamePassesWithAndWithoutPairs) {
  const ToneScene scene = far_scene(20);
  EXPECT_EQ(count_trimming_passes(scene, {.ceiling = HistogramCeiling::kLinear}, 1).passes,
            measure_trimming_consistency(scene, HistogramCeiling::kLinear, std::nullopt, 1).passes);
}

TEST(VisibleLumaChange, IsAFewGreyLevelsOf256) {
  EXPECT_GT(visible_luma_change(), 1.0 / 256);
  EXPECT_LT(visible_luma_change(), 8.0 / 256);
}

}  // namespace
}  // namespace plenolab
