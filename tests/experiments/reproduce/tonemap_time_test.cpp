#include <gtest/gtest.h>

#include <cmath>

#include "experiments/reproduce/tonemap/adaptation_tracks.h"
#include "experiments/reproduce/tonemap/central_part.h"

namespace plenolab {
namespace {

constexpr double kT0 = kRodAdaptation_s;

TEST(TrackOfStep, FollowsTheExponentialWithAnyHeldStep) {
  for (const double step_s : {0.01, 0.1, 1.0}) {
    const auto track = track_of_step({}, step_s, 5);
    ASSERT_EQ(track.size(), 6u);
    for (std::size_t i = 0; i < track.size(); ++i)
      EXPECT_NEAR(track[i], 1 - std::exp(-static_cast<double>(i) * step_s / kT0), 1e-12);
  }
}

TEST(TrackOfStep, OfExplicitEulerDivergesBeyondTwoTimeConstants) {
  const AdaptationOptions euler{.scheme = AdaptationScheme::kExplicitEuler};
  EXPECT_GT(std::abs(track_of_step(euler, 2.5 * kT0, 30).back()), 1e3);
  EXPECT_NEAR(track_of_step(euler, 1.5 * kT0, 60).back(), 1, 1e-6);
}

TEST(LagOnRamp, IsTheTimeConstantWithALinearTargetAndLessWithAHeldOne) {
  const double step_s = 1.0 / 30;
  EXPECT_NEAR(lag_on_ramp_s({.scheme = AdaptationScheme::kLinearTarget}, step_s), kT0, 1e-9);
  EXPECT_NEAR(lag_on_ramp_s({}, step_s), step_s / std::expm1(step_s / kT0), 1e-9);
}

/// One view whose red is the column and whose green is the row.
LightField coordinates(int width, int height) {
  KeyView<SceneReferred> view{SceneImage(width, height), DisparityMap(width, height, 3)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) view.colour.at(x, y) = {static_cast<float>(x), static_cast<float>(y), 0};
  return LightField::from_views({.columns = 1, .rows = 1, .width = width, .height = height, .fov_h_deg = 90},
                                RadianceUnit::kCdM2, "coordinates", {view});
}

TEST(CentralPart, KeepsTheMiddlePixelsAndTheirDepth) {
  const LightField whole = coordinates(30, 18), part = central_part(whole, 3);
  EXPECT_EQ(part.grid().width, 10);
  EXPECT_EQ(part.grid().height, 6);
  const auto view = part.view(0, 0);
  EXPECT_EQ(view->colour.at(0, 0), (Rgb{10, 6, 0}));
  EXPECT_EQ(view->colour.at(9, 5), (Rgb{19, 11, 0}));
  EXPECT_NEAR(part.grid().depth_m(3), whole.grid().depth_m(3), 1e-9);
}

TEST(CentralPart, LeavesEqualMargins) {
  const LightField part = central_part(coordinates(31, 16), 3);
  EXPECT_EQ((31 - part.grid().width) % 2, 0);
  EXPECT_EQ((16 - part.grid().height) % 2, 0);
}

}  // namespace
}  // namespace plenolab
