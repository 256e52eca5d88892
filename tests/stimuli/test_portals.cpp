#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/tracer/path_tracer.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab::tracer {
namespace {

using namespace testing;

// A room with one opening in the ceiling.
Scene room_scene(bool with_portal) {
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.6f)};
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    scene.meshes.push_back(parallelogram(corner, u, v, 0));
  };
  wall({-2, -2, -1}, {4, 0, 0}, {0, 4, 0});
  wall({-2, -2, 1}, {4, 0, 0}, {0, 3, 0});
  wall({-2, 1.5f, 1}, {4, 0, 0}, {0, 0.5f, 0});
  wall({-2, -2, -1}, {4, 0, 0}, {0, 0, 2});
  wall({-2, 2, -1}, {4, 0, 0}, {0, 0, 2});
  wall({-2, -2, -1}, {0, 4, 0}, {0, 0, 2});
  wall({2, -2, -1}, {0, 4, 0}, {0, 0, 2});
  scene.sky = uniform_sky(1000, 0);
  if (with_portal) scene.portals = {{Vec3(-2, 1, 1), Vec3(4, 0, 0), Vec3(0, 0.5f, 0)}};
  return scene;
}

// The same room under the sun instead of the sky, and dusty; the cameras do not see its patch of sunlight.
Scene sunlit_room(bool with_portal, Material::Kind floor) {
  Scene scene = room_scene(with_portal);
  Material ground = diffuse(0.7f);
  ground.kind = floor;
  ground.roughness = constant(0.5f);
  scene.materials.push_back(ground);
  scene.meshes.front().material = 1;
  scene.sky = Sky{};
  scene.sun = Sun{.direction = Vec3(0.1f, 0.25f, 1).normalized(), .angular_diameter_deg = 3};
  scene.medium = Medium{Vec3(-2, -2, -1), Vec3(2, 2, 1), 0.02f, 0.05f, 0.3f};
  scene.camera.forward = Vec3(0, -1, 0);
  scene.max_bounces = 3;
  return scene;
}

struct Estimate {
  double mean, variance;
};

// Mean radiance of a few pixels with the variance of that mean, from repeated renderings.
Estimate estimate(const Scene& scene, int paths, int runs) {
  const PreparedScene prepared(scene);
  double sum = 0, squares = 0;
  for (int i = 0; i < runs; ++i) {
    RenderSettings settings;
    settings.paths_per_pixel = paths;
    settings.seed = static_cast<std::uint64_t>(i);
    const double mean = mean_green(render_view(prepared, small_grid(6, 4), {0, 0}, settings).view.colour);
    sum += mean, squares += mean * mean;
  }
  const double mean = sum / runs;
  return {mean, (squares / runs - mean * mean) / (runs - 1)};
}

// Welch's t; 4.5 standard errors are passed by chance once in 10^4 or less.
void expect_same_mean(const Estimate& a, const Estimate& b) {
  EXPECT_LT(std::abs(a.mean - b.mean), 4.5 * std::sqrt(a.variance + b.variance))
      << a.mean << " and " << b.mean;
}

TEST(Portals, GiveTheSameLightAsTheWholeSkyWithLessNoise) {
  const Estimate whole = estimate(room_scene(false), 64, 24), portal = estimate(room_scene(true), 64, 24);
  expect_same_mean(whole, portal);
  EXPECT_LT(portal.variance, whole.variance);
}

TEST(Portals, ReportTheDensityTheyDrawWith) {
  Scene scene = room_scene(true);
  scene.portals.push_back({Vec3(-1, 1.2f, 0.8f), Vec3(2, 0, 0), Vec3(0, 0.5f, 0.1f)});  // behind one another
  const Portals portals(scene);
  const Vec3 origin(0.3f, -1, -0.9f);
  EXPECT_LT(integrate_sphere([&](const Vec3& d) { return static_cast<double>(portals.pdf(origin, d)); }, 512),
            1.02);
  EXPECT_GT(integrate_sphere([&](const Vec3& d) { return static_cast<double>(portals.pdf(origin, d)); }, 512),
            0.98);
  const DirectionSample s = portals.sample(origin, 0.1f, {0.5f, 0.5f});
  EXPECT_FLOAT_EQ(s.pdf, portals.pdf(origin, s.direction));
  EXPECT_EQ(portals.pdf(origin, Vec3(0, 0, -1)), 0);
}

TEST(SunPatches, GiveTheSameLightAsChanceWithMuchLessNoise) {
  for (const auto floor : {Material::Kind::kDiffuse, Material::Kind::kGlossy, Material::Kind::kMetal}) {
    const Estimate chance = estimate(sunlit_room(false, floor), 256, 40);
    const Estimate joined = estimate(sunlit_room(true, floor), 64, 40);
    expect_same_mean(chance, joined);
    EXPECT_LT(joined.variance, chance.variance / 2);  // with a quarter of the paths
    // The means are known well enough to tell a strategy counted twice or not at all.
    EXPECT_LT(std::sqrt(chance.variance), 0.05 * chance.mean);
  }
}

TEST(SunPatches, CoverTheAreaTheSunShinesOn) {
  // Floor and opening are parallel: the patch is a copy of the opening of 4 m × 0.5 m, but for the end the
  // slant of the sun throws onto the wall (0.1 m per metre of height) and the blur of the disc.
  Scene scene = sunlit_room(true, Material::Kind::kDiffuse);
  scene.sun->angular_diameter_deg = 0.01f;
  const World world(scene);
  ASSERT_FALSE(world.patches.empty());
  double floor_area = 0;
  const std::uint32_t draws = 1 << 14;
  for (std::uint32_t i = 0; i < draws; ++i) {
    const PathSampler sampler(3, i);
    const auto point = world.patches.sample(sampler.get_1d(0), sampler.get_2d(1), sampler.get_2d(2));
    if (!point) continue;
    EXPECT_FALSE(world.rays.occluded(
        {offset_origin(point->hit.point.position_m, point->hit.geometric_normal, point->hit.geometric_normal),
         point->sun_direction}));
    if (point->hit.point.position_m.z() < -0.999f) floor_area += 1.0 / static_cast<double>(point->pdf_area);
  }
  EXPECT_NEAR(floor_area / draws, (4 - 0.2) * 0.5, 0.02);
}

TEST(SunPatches, AreNoneWithoutOpeningsOrWhereTheSunDoesNotComeThrough) {
  EXPECT_TRUE(World(sunlit_room(false, Material::Kind::kDiffuse)).patches.empty());
  Scene below = sunlit_room(true, Material::Kind::kDiffuse);
  below.sun->direction = Vec3(0, 0.6f, -0.8f);
  const World world(below);
  EXPECT_TRUE(world.patches.empty());
  EXPECT_EQ(world.patches.pdf_area(Vec3(0, 0, 0), Vec3(0, 0, 1), below.sun->direction), 0);
  EXPECT_FALSE(world.patches.sample(0.5f, {0.5f, 0.5f}, {0.5f, 0.5f}).has_value());
}

}  // namespace
}  // namespace plenolab::tracer
