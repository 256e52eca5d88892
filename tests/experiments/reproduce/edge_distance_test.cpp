#include "experiments/reproduce/display/edge_distance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plenolab {
namespace {

int count(const Mask& mask) {
  return static_cast<int>(std::count(mask.pixels().begin(), mask.pixels().end(), 1));
}

TEST(EdgeDistance, AnEdgeLiesWhereDisparityJumpsAndNotWhereSubimagesMeet) {
  const SubimageLayout rendered{2, 1, 8};
  Plane<float> disparity(16, 8, 1.0f);
  for (int y = 0; y < 8; ++y)
    for (int x = 8; x < 16; ++x) disparity.at(x, y) = 2;  // the second subimage lies nearer as a whole
  EXPECT_EQ(count(depth_edges(disparity, rendered, 2, 0.1f)), 0);
  for (int y = 0; y < 8; ++y)
    for (int x = 5; x < 8; ++x) disparity.at(x, y) = 1.2f;
  const Mask edges = depth_edges(disparity, rendered, 2, 0.1f);
  EXPECT_EQ(edges.width(), 8);
  EXPECT_EQ(count(edges), 4);
  for (int y = 0; y < 4; ++y) EXPECT_EQ(edges.at(2, y), 1) << "the jump from 4 to 5 is in pixel 2";
  EXPECT_EQ(count(depth_edges(disparity, rendered, 2, 0.3f)), 0);
}

TEST(EdgeDistance, AHoleIsMarkedWithARingThatStaysInItsSubimage) {
  const SubimageLayout rendered{2, 1, 8};
  Plane<float> taken(16, 8, 1.0f);
  taken.at(3, 4) = -1;
  EXPECT_EQ(count(holes_with_ring(taken, rendered, 2)), 9);
  taken.at(3, 4) = 1;
  taken.at(7, 0) = -1;  // a corner of the first subimage
  const Mask holes = holes_with_ring(taken, rendered, 2);
  EXPECT_EQ(count(holes), 4);
  EXPECT_EQ(holes.at(3, 0), 1);
  EXPECT_EQ(holes.at(4, 0), 0);
}

TEST(EdgeDistance, StepsCountAlongRowsAndColumnsAndStayInTheSubimage) {
  Mask marked(10, 5, 0);
  marked.at(1, 3) = 1;
  const Plane<int> steps = steps_to_marked(marked, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(steps.at(x, y), std::abs(x - 1) + std::abs(y - 3));
  for (int x = 5; x < 10; ++x) EXPECT_EQ(steps.at(x, 3), kNoneMarked);
}

}  // namespace
}  // namespace plenolab
