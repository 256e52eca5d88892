#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/synthesis/key_views.h"
#include "core/synthesis/synthesizer.h"
#include "core/synthesis/visibility_map.h"
#include "test_fields.h"

namespace plenolab {
namespace {

using namespace testing_support;

TEST(KeyViews, WeightsOfACellSumToOne) {
  const ViewGrid grid = grid_of(4, 3, 8, 8);
  for (double s : {0.0, 0.3, 1.0, 2.999, 3.0})
    for (double t : {0.0, 0.5, 1.7, 2.0}) {
      double sum = 0;
      for (const UsedView& view : select_key_views(grid, {s, t})) {
        sum += view.weight;
        EXPECT_LE(std::abs(view.b_x), 1);
        EXPECT_LE(std::abs(view.b_y), 1);
      }
      EXPECT_NEAR(sum, 1, 1e-15) << s << ", " << t;
    }
}

TEST(KeyViews, AreTheNearestOfTheCell) {
  const ViewGrid grid = grid_of(4, 3, 8, 8);
  const auto views = select_key_views(grid, {1.2, 1.9}, 2);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].column, 1);
  EXPECT_EQ(views[0].row, 2);
  EXPECT_EQ(select_key_views(grid, {2, 1}).size(), 1u);
  EXPECT_EQ(select_key_views(grid_of(3, 1, 8, 8), {0.5, 0}).size(), 2u);
  EXPECT_EQ(select_key_views(grid_of(1, 1, 8, 8), {0, 0}).size(), 1u);
}

TEST(VisibilityMap, IsGreenWhereAllViewsSeeAndRedWhereNoneDoes) {
  const ViewGrid grid = grid_of(2, 2, 60, 40);
  auto view = synthesize(plane_field(grid, 0), {0.5, 0.5});
  view.visible_views.at(5, 5) = 0;
  view.visible_views.at(6, 5) = 2;
  view.unseen.at(7, 5) = 1;
  const DisplayImage map = visibility_map(view);
  EXPECT_EQ(map.at(20, 20).r, 0);
  EXPECT_GE(map.at(20, 20).g, 0.6f);
  EXPECT_EQ(map.at(5, 5).g, 0);
  EXPECT_GE(map.at(5, 5).r, 0.6f);
  EXPECT_EQ(map.at(6, 5).r, map.at(6, 5).g);
  EXPECT_EQ(map.at(7, 5), (Rgb{1, 0, 0}));
}

TEST(VisibilityMap, IsReadableWhereTheSceneIsBlackAndBrighterWhereItIsBright) {
  auto view = synthesize(plane_field(grid_of(2, 2, 60, 40), 0), {0.5, 0.5});
  for (Rgb& c : view.image.pixels()) c = {0, 0, 0};
  view.image.at(30, 20) = {1, 1, 1};
  for (int count = 0; count <= 4; ++count)
    view.visible_views.at(10 + count, 5) = static_cast<std::uint8_t>(count);
  const DisplayImage map = visibility_map(view);
  for (int count = 0; count <= 4; ++count) {
    const Rgb c = map.at(10 + count, 5);
    EXPECT_FLOAT_EQ(std::max(c.r, c.g), 0.6f) << count;
  }
  EXPECT_GT(map.at(30, 20).g, map.at(20, 20).g);
}

TEST(Synthesizer, KeepsPreparedViewsWithinItsMemoryBound) {
  const LightField field = plane_field(grid_of(5, 2, 40, 30), 3);
  const Synthesizer large(field), small(field, 1);
  const auto path = straight_path({0, 0.5}, {4, 0.5}, 9);
  std::size_t received = 0;
  small.synthesize_sequence(path, {}, [&](std::size_t n, NovelView<SceneReferred>&& view) {
    EXPECT_EQ(n, received++);
    EXPECT_TRUE(view.image == large.synthesize(path[n]).image);
  });
  EXPECT_EQ(received, path.size());
  EXPECT_LT(small.prepared_bytes(), large.prepared_bytes());
}

TEST(StraightPath, HasBothEndsAndRefusesNoPositions) {
  const auto path = straight_path({0, 1}, {2, 0}, 5);
  ASSERT_EQ(path.size(), 5u);
  EXPECT_EQ(path[2], (CameraPosition{1, 0.5}));
  EXPECT_EQ(path[4], (CameraPosition{2, 0}));
  EXPECT_EQ(straight_path({0, 1}, {2, 0}, 1).size(), 1u);
  EXPECT_THROW(straight_path({0, 0}, {1, 1}, 0), InputError);
}

}  // namespace
}  // namespace plenolab
