#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/lightfield/light_field_folder.h"
#include "core/lightfield/self_check.h"
#include "tests/core/lightfield/synthetic.h"

namespace plenolab {
namespace {

using Views = std::vector<KeyView<SceneReferred>>;

LightField make(const ViewGrid& grid, Views views) {
  return LightField::from_views(grid, RadianceUnit::kCdM2, "test", std::move(views));
}

// Views in another order: `source(column, row)` gives the index of the view put at (column, row).
LightField reordered(const TwoPlanes& scene, const std::function<std::pair<int, int>(int, int)>& source) {
  const Views views = scene.views();
  Views moved;
  for (int row = 0; row < scene.grid.rows; ++row)
    for (int column = 0; column < scene.grid.columns; ++column) {
      const auto [c, r] = source(column, row);
      moved.push_back(views[static_cast<std::size_t>(r * scene.grid.columns + c)]);
    }
  return make(scene.grid, std::move(moved));
}

LightField scaled(const TwoPlanes& scene, float factor) {
  Views views = scene.views();
  for (auto& view : views)
    for (float& d : view.disparity.pixels()) d *= factor;
  return make(scene.grid, std::move(views));
}

TEST(SelfCheck, ACorrectLightFieldIsConsistent) {
  const SelfCheckResult result = self_check(TwoPlanes{}.light_field());
  EXPECT_EQ(result.verdict, SelfCheckVerdict::kConsistent) << result.explanation;
  EXPECT_NEAR(result.best_scale, 1, 0.05);
  EXPECT_EQ(result.pairs, 8);
  EXPECT_NO_THROW(require_consistent(result, "test"));
}

TEST(SelfCheck, EveryMistakeOfOrderIsNamed) {
  const TwoPlanes scene;
  EXPECT_EQ(self_check(reordered(scene, [](int c, int r) { return std::pair(2 - c, r); })).verdict,
            SelfCheckVerdict::kWrongSignX);
  EXPECT_EQ(self_check(reordered(scene, [](int c, int r) { return std::pair(c, 2 - r); })).verdict,
            SelfCheckVerdict::kWrongSignY);
  EXPECT_EQ(self_check(reordered(scene, [](int c, int r) { return std::pair(2 - c, 2 - r); })).verdict,
            SelfCheckVerdict::kWrongSignBoth);
  const SelfCheckResult swapped = self_check(reordered(scene, [](int c, int r) { return std::pair(r, c); }));
  EXPECT_EQ(swapped.verdict, SelfCheckVerdict::kSwappedAxes);
  EXPECT_THROW(require_consistent(swapped, "test"), InputError);
}

TEST(SelfCheck, AWrongScaleIsEstimated) {
  for (const float factor : {0.5f, 2.0f, 1.5f, 0.7f}) {
    const SelfCheckResult result = self_check(scaled(TwoPlanes{}, factor));
    EXPECT_EQ(result.verdict, SelfCheckVerdict::kWrongScale) << factor << " " << result.explanation;
    EXPECT_NEAR(result.best_scale, 1 / factor, 0.08 / factor);
  }
}

TEST(SelfCheck, AWrongRatioOfTheSpacingsIsFoundAlongItsAxis) {
  TwoPlanes scene;
  const Views views = scene.views();
  for (const double factor : {0.5, 2.0}) {
    ViewGrid grid = scene.grid;
    grid.spacing_y_m *= factor;
    const SelfCheckResult result = self_check(make(grid, views));
    EXPECT_EQ(result.verdict, SelfCheckVerdict::kWrongScale) << factor << " " << result.explanation;
    EXPECT_NEAR(result.best_scale_x, 1, 0.05) << factor;
    EXPECT_NEAR(result.best_scale_y * factor, 1, 0.1) << factor;
  }
}

TEST(SelfCheck, UnequalSpacingsScaleVerticalShifts) {
  TwoPlanes scene;
  scene.grid.spacing_y_m = 0.15;
  EXPECT_EQ(self_check(scene.light_field()).verdict, SelfCheckVerdict::kConsistent);
  LightField wrong = [&] {
    ViewGrid grid = scene.grid;
    grid.spacing_y_m = 0.05;
    return make(grid, scene.views());
  }();
  EXPECT_GT(self_check(wrong).error(DisparityHypothesis::kAsStated),
            2 * self_check(scene.light_field()).error(DisparityHypothesis::kAsStated));
}

TEST(SelfCheck, ASingleRowIsJudgedAlongColumns) {
  TwoPlanes scene;
  scene.grid.rows = 1;
  EXPECT_EQ(self_check(scene.light_field()).verdict, SelfCheckVerdict::kConsistent);
  EXPECT_EQ(self_check(reordered(scene, [](int c, int r) { return std::pair(2 - c, r); })).verdict,
            SelfCheckVerdict::kWrongSignX);
}

TEST(SelfCheck, WithoutTextureDisparityOrNeighboursNothingIsDecided) {
  TwoPlanes flat;
  flat.near_px = flat.far_px = 0;
  EXPECT_EQ(self_check(flat.light_field()).verdict, SelfCheckVerdict::kUndecidable);
  Views grey = TwoPlanes{}.views();
  for (auto& view : grey) view.colour = SceneImage(96, 72, {1, 1, 1});
  EXPECT_EQ(self_check(make(TwoPlanes{}.grid, std::move(grey))).verdict, SelfCheckVerdict::kUndecidable);
  TwoPlanes single;
  single.grid.columns = single.grid.rows = 1;
  const SelfCheckResult alone = self_check(single.light_field());
  EXPECT_EQ(alone.verdict, SelfCheckVerdict::kUndecidable);
  EXPECT_EQ(alone.pairs, 0);
}

TEST(SelfCheck, EqualViewsWithDisparityAreInconsistent) {
  const TwoPlanes scene;
  const SelfCheckResult result = self_check(reordered(scene, [](int, int) { return std::pair(1, 1); }));
  EXPECT_EQ(result.verdict, SelfCheckVerdict::kInconsistent) << result.explanation;
}

TEST(SelfCheck, TheResultDoesNotDependOnThreads) {
  const LightField light_field = TwoPlanes{}.light_field();
  const SelfCheckResult one = self_check(light_field, {.threads = 1}),
                        three = self_check(light_field, {.threads = 3});
  for (std::size_t i = 0; i < one.errors.size(); ++i) EXPECT_EQ(one.errors[i].error, three.errors[i].error);
}

TEST(SelfCheck, DefectivePixelsAndExtremeRadianceDoNotDisturb) {
  TwoPlanes scene;
  for (const float radiance : {1e-9f, 1e9f}) {
    scene.radiance = radiance;
    Views views = scene.views();
    for (auto& view : views) {
      view.colour.at(3, 3) = {std::nanf(""), 0, 0};
      view.colour.at(50, 40) = {INFINITY, 0, 0};
      view.colour.at(60, 60) = {-1, -1, -1};
    }
    EXPECT_EQ(self_check(make(scene.grid, std::move(views))).verdict, SelfCheckVerdict::kConsistent);
  }
}

TEST(SelfCheck, DisplayValuesAreComparedAsTheyAre) {
  TwoPlanes scene;
  scene.radiance = 1;
  EXPECT_EQ(self_check(scene.light_field<DisplayReferred>()).verdict, SelfCheckVerdict::kConsistent);
}

TEST(SelfCheck, ALightFieldOfAnotherRendererIsConsistent) {
  const char* outside = std::getenv("PLENOLAB_OUTSIDE_DATA");
  if (!outside) GTEST_SKIP() << "set PLENOLAB_OUTSIDE_DATA to a folder that holds blender-3x3/";
  const SelfCheckResult result = self_check(open_light_field(std::filesystem::path(outside) / "blender-3x3"));
  for (const HypothesisError& e : result.errors) std::printf("%-18s %.5f\n", describe(e.hypothesis), e.error);
  std::printf("best scale %.3f\n", result.best_scale);
  EXPECT_EQ(result.verdict, SelfCheckVerdict::kConsistent) << result.explanation;
  EXPECT_NEAR(result.best_scale, 1, 0.06);
}

}  // namespace
}  // namespace plenolab
