#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "stimuli/direct/direct_view.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

/// A wall of albedo ½ at y = 2 m, facing the cameras, wider than they see.
Scene wall() {
  Scene scene;
  scene.materials = {testing::diffuse(0.5f)};
  scene.meshes = {testing::parallelogram({-5, 2, -5}, {10, 0, 0}, {0, 0, 10}, 0)};
  scene.camera.fov_h_deg = 20;
  return scene;
}

ViewGrid grid_of_views() {
  return {3, 2, 0.01, 0.01, 24, 24, 20};
}

TEST(DirectView, HasPlanarDepthExactlyAtPixelCentres) {
  const DirectView view = render_direct(DirectScene(wall()), grid_of_views(), {0, 1});
  for (const float z : view.depth_m.pixels()) ASSERT_NEAR(z, 2, 1e-5f);
}

TEST(DirectView, ShadesByLambertsLawUnderSunAndSky) {
  Scene scene = wall();
  scene.sun = Sun{.direction = Vec3(0, -1, 1).normalized(), .illuminance_lx = {1000, 1000, 1000}};
  scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = {100, 100, 100}, .ground_cd_m2 = {50, 50, 50}};
  const DirectView view = render_direct(DirectScene(scene), grid_of_views(), {1, 0.5});
  const double pi = std::numbers::pi;
  // Albedo/π · (E_sun cos 45° + π · half of sky and ground each).
  const double expected = 0.5 / pi * (1000 * std::cos(pi / 4) + pi * 75);
  for (const Rgb& c : view.radiance.pixels())
    ASSERT_NEAR(static_cast<double>(c.r), expected, 1e-3 * expected);
}

TEST(DirectView, DarkensWhatTheSunDoesNotReach) {
  Scene scene = wall();
  scene.sun = Sun{.direction = Vec3(0, -1, 1).normalized(), .illuminance_lx = {1000, 1000, 1000}};
  // Between the wall and the sun, above what the cameras see.
  scene.meshes.push_back(testing::parallelogram({-5, 0.5f, 0.9f}, {10, 0, 0}, {0, 1.2f, 0}, 0));
  const DirectView view = render_direct(DirectScene(scene), grid_of_views(), {1, 0.5});
  EXPECT_EQ(view.radiance.at(12, 12), Rgb{});
}

TEST(DirectView, SeesTheSkyAtInfinity) {
  Scene scene = wall();
  scene.meshes[0] = testing::parallelogram({-5, 2, -5}, {10, 0, 0}, {0, 0, 5}, 0);  // below the horizon only
  scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = {1, 2, 3}, .ground_cd_m2 = {4, 5, 6}};
  const DirectView view = render_direct(DirectScene(scene), {1, 1, 0.01, 0.01, 24, 24, 20}, {0, 0});
  EXPECT_EQ(view.depth_m.at(3, 3), std::numeric_limits<float>::infinity());
  EXPECT_EQ(view.radiance.at(3, 3), (Rgb{1, 2, 3}));
}

TEST(DirectView, IsTheSameAloneAndAmongAllViewsAndForAnyNumberOfThreads) {
  const DirectScene scene(wall());
  const ViewGrid grid = grid_of_views();
  const DirectView all = render_direct_views(scene, grid, 2);
  EXPECT_EQ(all.radiance, render_direct_views(scene, grid, 1).radiance);
  const DirectView one = render_direct(scene, grid, {2, 1}, 1);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      ASSERT_EQ(all.radiance.at(2 * grid.width + x, grid.height + y), one.radiance.at(x, y));
      ASSERT_EQ(all.depth_m.at(2 * grid.width + x, grid.height + y), one.depth_m.at(x, y));
    }
}

TEST(DirectView, ShowsPointsWhereTheirDepthSaysAlsoFromTheNextCamera) {
  // A point of the wall moves by f·b/z between neighbouring cameras; texture is a function of position.
  Scene scene = wall();
  scene.materials[0].albedo = [](const SurfacePoint& p) {
    const float v = 0.5f + 0.4f * std::sin(20 * p.position_m.x());
    return Rgb{v, v, v};
  };
  scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = {100, 100, 100}, .ground_cd_m2 = {100, 100, 100}};
  ViewGrid grid{2, 1, 0, 1, 48, 48, 20};
  // A spacing of exactly three pixels at 2 m.
  grid.spacing_x_m = 3 * 2 * 2 * std::tan(10 * std::numbers::pi / 180) / 48;
  const DirectScene prepared(scene);
  const DirectView left = render_direct(prepared, grid, {0, 0}),
                   right = render_direct(prepared, grid, {1, 0});
  for (int x = 3; x < 48; ++x) EXPECT_NEAR(right.radiance.at(x - 3, 20).r, left.radiance.at(x, 20).r, 0.02f);
}

}  // namespace
}  // namespace plenolab
