#include "core/lightfield/subsample.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace plenolab {
namespace {

LightField numbered_field(int columns, int rows) {
  const ViewGrid grid{columns, rows, 0.1, 0.2, 3, 2, 60};
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      views.push_back({SceneImage(3, 2, Rgb{float(column), float(row), 0}), DisparityMap(3, 2, 1.5f)});
  return LightField::from_views(grid, RadianceUnit::kRelative, "numbered", std::move(views));
}

TEST(Subsample, KeepsEveryStrideThViewAndScalesSpacingAndDisparityTogether) {
  const LightField sparse = subsample(numbered_field(5, 3), 2);
  EXPECT_EQ(sparse.grid().columns, 3);
  EXPECT_EQ(sparse.grid().rows, 2);
  EXPECT_DOUBLE_EQ(sparse.grid().spacing_x_m, 0.2);
  EXPECT_DOUBLE_EQ(sparse.grid().spacing_y_m, 0.4);
  EXPECT_EQ(sparse.view(2, 1)->colour.at(0, 0), (Rgb{4, 2, 0}));
  EXPECT_FLOAT_EQ(sparse.view(2, 1)->disparity.at(1, 1), 3.0f);
  EXPECT_FLOAT_EQ(sparse.max_disparity_px(), 3.0f);
}

TEST(Subsample, DepthOfASurfaceDoesNotChange) {
  const LightField dense = numbered_field(5, 3);
  const LightField sparse = subsample(dense, 4);
  EXPECT_NEAR(dense.grid().depth_m(1.5), sparse.grid().depth_m(sparse.view(0, 0)->disparity.at(0, 0)), 1e-6);
}

TEST(Subsample, AnAxisWithOneViewKeepsItsSpacingAndViews) {
  const LightField sparse = subsample(numbered_field(5, 1), 2);
  EXPECT_EQ(sparse.grid().rows, 1);
  EXPECT_DOUBLE_EQ(sparse.grid().spacing_y_m, 0.2);
  const LightField column = subsample(numbered_field(1, 5), 2);
  EXPECT_FLOAT_EQ(column.view(0, 1)->disparity.at(0, 0), 1.5f)
      << "disparity is per column spacing, which did not change";
}

TEST(Subsample, DropsViewsBehindTheLastKeptOne) {
  EXPECT_EQ(subsample(numbered_field(6, 1), 4).grid().columns, 2);
}

TEST(Subsample, RefusesAStrideBelowOne) {
  EXPECT_THROW(subsample(numbered_field(2, 2), 0), InputError);
}

}  // namespace
}  // namespace plenolab
