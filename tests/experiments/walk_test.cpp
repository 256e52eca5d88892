// The walk through three volumes, its looks, and sweeps of look-up tables.
#include "experiments/walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/lut/grade.h"
#include "experiments/colour_error.h"
#include "experiments/grade_chain.h"
#include "experiments/sweep_lut.h"

namespace plenolab {
namespace {

double distance_m(const Point3& a, const Point3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double turn_deg(const Point3& a, const Point3& b) {
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI;
}

TEST(Walk, GoesInSmallStepsAndTurnsOnTheSpotBetweenVolumes) {
  const std::vector<WalkPose> path = walk_path();
  const WalkStage stage;
  ASSERT_GE(path.size(), 30u);
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_LT(distance_m(path[i].camera.position_m, path[i - 1].camera.position_m), 1.6) << i;
    EXPECT_LT(turn_deg(path[i].camera.forward, path[i - 1].camera.forward), 35) << i;
    EXPECT_NO_THROW(path[i].camera.validate());
  }
  for (const WalkPose& pose : path) {
    if (!pose.turning) continue;
    EXPECT_EQ(innermost(stage.volumes(), pose.camera.position_m), -1);
    int near = 0;
    for (const Volume& v : stage.volumes())
      near += v.distance_m(pose.camera.position_m) < v.blend_radius_m ? 1 : 0;
    EXPECT_EQ(near, 2) << "both neighbours' blend radius reaches the walker";
  }
}

TEST(Walk, StandsForHalfATurnIncludingItsEndAndMovesInAllOtherFrames) {
  const std::vector<WalkPose> path = walk_path();
  std::vector<std::vector<std::size_t>> turns;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!path[i].turning) continue;
    if (turns.empty() || turns.back().back() + 1 != i) turns.emplace_back();
    turns.back().push_back(i);
  }
  ASSERT_EQ(turns.size(), 2u);
  for (const std::vector<std::size_t>& turn : turns) {
    const DepthCamera &first = path[turn.front()].camera, &last = path[turn.back()].camera;
    EXPECT_EQ(distance_m(first.position_m, last.position_m), 0);
    EXPECT_NEAR(turn_deg(first.forward, last.forward), 180, 1e-3);
    EXPECT_GT(distance_m(path[turn.back() + 1].camera.position_m, last.position_m), 0)
        << "no frame is left out";
  }
}

TEST(Walk, DensityChangesTheNumberOfPosesOnly) {
  const std::vector<WalkPose> coarse = walk_path(1e-9), fine = walk_path(3), plain = walk_path();
  EXPECT_EQ(coarse.size(), 8u) << "seven legs and the end";
  EXPECT_EQ(fine.size() - 1, 3 * (plain.size() - 1));
  for (const std::vector<WalkPose>& path : {coarse, fine}) {
    EXPECT_EQ(path.front().camera.position_m, plain.front().camera.position_m);
    EXPECT_EQ(path.back().camera.position_m, plain.back().camera.position_m);
  }
}

TEST(Walk, NeverLeadsThroughAWallAndShowsEveryPlace) {
  const WalkStage stage;
  std::vector<double> most(stage.volumes().size() + 1);
  for (const WalkPose& pose : walk_path()) {
    const WalkFrame frame = stage.surfaces(pose, 64, 36);
    for (const float z : frame.depth_m.pixels()) EXPECT_GT(z, 0.25f) << pose.leg;
    const VolumeWeights weights =
        pixel_weights(count_pixels(frame.depth_m, pose.camera, stage.volumes()), stage.volumes());
    for (std::size_t v = 0; v < stage.volumes().size(); ++v) most[v] = std::max(most[v], weights.volumes[v]);
    most.back() = std::max(most.back(), weights.background);
  }
  for (const double share : most) EXPECT_GT(share, 0.4);
}

TEST(Walk, FastCountsOfItsFramesAreThoseOfTheLiteralAlgorithm) {
  const WalkStage stage;
  for (const WalkPose& pose : walk_path(0.3)) {
    const WalkFrame frame = stage.surfaces(pose, 160, 90);
    const VolumeCounts counts = count_pixels(frame.depth_m, pose.camera, stage.volumes());
    std::vector<std::int64_t> literal(stage.volumes().size());
    const Plane<int> volume = volume_of_pixels(frame.depth_m, pose.camera, stage.volumes());
    for (const int v : volume.pixels())
      if (v >= 0) ++literal[static_cast<std::size_t>(v)];
    for (std::size_t v = 0; v < literal.size(); ++v)
      EXPECT_NEAR(static_cast<double>(counts.volumes[v]), static_cast<double>(literal[v]), 3) << pose.leg;
  }
}

TEST(Walk, FramesShowTheSkyAtInfinityWithoutAnObject) {
  const WalkStage stage;
  const WalkPose outside = walk_path().back();
  const WalkFrame frame = stage.frame(outside, 64, 36);
  int sky = 0;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    EXPECT_EQ(std::isinf(frame.depth_m.pixels()[i]), frame.object.pixels()[i] < 0);
    EXPECT_LT(frame.object.pixels()[i], static_cast<int>(stage.objects().size()));
    sky += frame.object.pixels()[i] < 0 ? 1 : 0;
  }
  EXPECT_GT(sky, 200);
}

TEST(Walk, LooksBringAFrameNearerToTheirPalette) {
  const WalkStage stage;
  const DisplayImage source = stage.frame(walk_path()[20], 96, 54).picture;
  for (int i = 0; i < kWalkLooks; ++i) {
    const WalkLook look = make_walk_look(i, source, 17);
    EXPECT_LT(look.transfer.distance_after, 0.85 * look.transfer.distance_before) << look.name;
    EXPECT_EQ(walk_palette(i, 96, 54), look.palette) << "palettes are the same every time";
  }
}

TEST(GradeChain, StaysInRangeKeepsOrderAndIsExactInTheLinearPartOfItsCurve) {
  float last = -1;
  for (int i = 0; i <= 1000; ++i) {
    const float v = static_cast<float>(i) / 1000;
    const Rgb c = grade_chain({v, v, v});
    for (const float channel : {c.r, c.g, c.b}) {
      EXPECT_GE(channel, 0);
      EXPECT_LE(channel, 1);
    }
    EXPECT_GE(c.g, last);
    last = c.g;
  }
  EXPECT_FLOAT_EQ(gran_turismo_curve(0), 0);
  EXPECT_NEAR(gran_turismo_curve(0.3f), 0.3f, 1e-6) << "slope 1 from 0.22 to 0.532";
  EXPECT_NEAR(gran_turismo_curve(0.5f), 0.5f, 1e-6);
  EXPECT_NEAR(gran_turismo_curve(0.532f), 0.532f, 1e-4) << "the shoulder begins where the line ends";
  EXPECT_LT(gran_turismo_curve(50), 1.0001f);
  EXPECT_GT(gran_turismo_curve(50), 0.999f);
}

TEST(ColourErrors, AreTheMeanAndTheLargestOfAllPixels) {
  DisplayImage black(4, 2), one_white(4, 2);
  one_white.at(3, 1) = {1, 1, 1};
  const ColourError error = colour_error(one_white, black);
  EXPECT_NEAR(error.mean, 100.0 / 8, 1e-9);
  EXPECT_NEAR(error.largest, 100, 1e-9);
  EXPECT_EQ(colour_error(black, black).largest, 0);
}

/// Values of a quantity by the chain's name, in order.
std::map<std::string, std::vector<double>> by_chain(const ResultTable& table, const std::string& quantity) {
  std::map<std::string, std::vector<double>> values;
  for (const ResultRow& row : table.rows())
    if (row.quantity == quantity)
      values[std::get<std::string>(row.columns.at(1).second)].push_back(row.value);
  return values;
}

TEST(SweepLut, ErrorsFallWithTheSizeOfTheTable) {
  const DisplayImage picture = WalkStage().frame(walk_path()[24], 64, 36).picture;
  const ResultTable table = sweep_lut("frame", picture, {.runs = 1, .threads = 1, .progress = {}});
  for (const auto& [chain, errors] : by_chain(table, "mean_delta_e")) {
    ASSERT_EQ(errors.size(), 15u) << chain;
    EXPECT_EQ(errors[0], 0) << "the chain itself";
    // Sizes 8 to 64, trilinear, then tetrahedral.
    for (const std::size_t first : {1u, 8u}) {
      EXPECT_LT(errors[first + 6], 0.5 * errors[first]) << chain;
      EXPECT_GT(errors[first], 0.01) << chain;
    }
  }
  const Plot plot = plot_lut_sweep(table);
  EXPECT_NO_THROW(plot.validate());
  EXPECT_EQ(plot.series.size(), 4u) << "two chains, two interpolations";
  for (const PlotSeries& series : plot.series)
    EXPECT_TRUE(std::ranges::is_sorted(series.points, {}, &PlotPoint::x));
}

}  // namespace
}  // namespace plenolab
