#include "experiments/reproduce/display/match_residuals.h"

#include <gtest/gtest.h>

namespace plenolab {
namespace {

/// 5 × 3 subimages of 4 px of a plane at a disparity of 1 px per camera, every match exact.
struct Fixture {
  CameraArray array{{5, 3, 4}, 0.001, 20};
  Plane<float> truth{20, 12, 1.0f};
  ReprojectionResult result;

  Fixture() {
    result.disparity_px = truth;
    result.offset_px = Plane<float>(20, 12, 0.0f);
  }
  MatchResiduals residuals() const { return match_residuals(result, array, truth); }
};

TEST(MatchResiduals, ExactMatchesAreNotDisplacedAndCornersAreNone) {
  const MatchResiduals r = Fixture().residuals();
  EXPECT_EQ(r.matches, (15 - 4) * 16);
  EXPECT_EQ(r.beyond_half, 0);
  EXPECT_EQ(r.offsets[0], r.matches);
  EXPECT_EQ(r.displacements[0], r.matches);
}

TEST(MatchResiduals, ADisplacementIsTheErrorInDisparityTimesTheCamerasFromTheNearestCorner) {
  Fixture f;
  f.result.disparity_px.at(2 * 4 + 1, 4 + 1) = 0.6f;  // column 2, row 1: two cameras from a corner
  f.result.offset_px.at(2 * 4 + 1, 4 + 1) = 0.42f;
  const MatchResiduals r = f.residuals();
  EXPECT_NEAR(r.largest_displacement_px, 0.8, 1e-6);
  EXPECT_NEAR(r.largest_offset_px, 0.42, 1e-6);
  EXPECT_EQ(r.offsets[8], 1);
  EXPECT_EQ(r.displacements[5], 1);
  EXPECT_EQ(r.beyond_half, 1);
  EXPECT_EQ(r.background, 1) << "a smaller disparity lies behind";
  EXPECT_NEAR(r.share_from(5), 1 / r.matches, 1e-12);
}

TEST(MatchResiduals, TellsOutlinesFromOtherSurfaces) {
  Fixture f;
  f.truth.at(2 * 4 + 2, 4 + 1) = 3;
  f.result.disparity_px.at(2 * 4 + 1, 4 + 1) = 3;  // taken from the pixel beside
  f.result.disparity_px.at(2 * 4 + 2, 4 + 1) = 5;  // nearer than anything there
  const MatchResiduals r = f.residuals();
  EXPECT_EQ(r.beyond_half, 2);
  EXPECT_EQ(r.outline, 1);
  EXPECT_EQ(r.foreground, 1);
  EXPECT_EQ(r.background, 0);
}

TEST(MatchResiduals, HolesAreNoMatches) {
  Fixture f;
  f.result.disparity_px.at(9, 5) = -1;
  EXPECT_EQ(f.residuals().matches, (15 - 4) * 16 - 1);
}

TEST(MatchResiduals, OfSeveralScenesAddUp) {
  Fixture f;
  MatchResiduals sum = f.residuals();
  f.result.disparity_px.at(9, 5) = 0;
  sum.add(f.residuals());
  EXPECT_EQ(sum.matches, 2 * (15 - 4) * 16);
  EXPECT_EQ(sum.beyond_half, 1);
  EXPECT_NEAR(sum.largest_displacement_px, 2, 1e-6);
}

}  // namespace
}  // namespace plenolab
