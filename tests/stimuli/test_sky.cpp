#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/colour.h"
#include "stimuli/tracer/portals.h"
#include "stimuli/tracer/sky_light.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab::tracer {
namespace {

using namespace testing;

Scene daylight_scene(double elevation, float turbidity) {
  Scene scene = empty_scene();
  scene.sun = Sun{Vec3(static_cast<float>(std::cos(elevation)), 0, static_cast<float>(std::sin(elevation)))};
  scene.sky.kind = Sky::Kind::kDaylight;
  scene.sky.turbidity = turbidity;
  scene.sky.ground_cd_m2 = {500, 400, 300};
  return scene;
}

// Integral over the sphere by a midpoint rule.
template <class F>
double integrate_sphere(F f, int rows) {
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 2 * rows; ++j) {
      const double cosine = 1 - 2 * (i + 0.5) / rows, sine = std::sqrt(1 - cosine * cosine);
      const double phi = std::numbers::pi * (j + 0.5) / rows;
      sum += f(Vec3(static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
                    static_cast<float>(cosine)));
    }
  return sum * 4 * std::numbers::pi / (2.0 * rows * rows);
}

TEST(Sky, PreethamsZenithHasTheLuminanceOfThePaper) {
  // Zenith angle 45°, turbidity 3, worked by hand: χ = (4/9 − 1/40)·π/2, Yz = 7.1649·tan χ + 1.7727 kcd/m².
  const PreethamSky sky(std::numbers::pi / 4, 3);
  const double chi = (4.0 / 9.0 - 1.0 / 40.0) * std::numbers::pi / 2;
  const double expected = 1000 * (7.1649 * std::tan(chi) + 1.7727);
  EXPECT_NEAR(sky.zenith_luminance_cd_m2(), expected, 1e-6 * expected);
  EXPECT_NEAR(static_cast<double>(luminance(sky.radiance(1, std::cos(std::numbers::pi / 4)))), expected,
              1e-3 * expected);
}

TEST(Sky, ClearDaylightIsBlueAtTheZenithAndBrighterTowardsTheSun) {
  const PreethamSky sky(1.0, 2.5);
  const Rgb zenith = sky.radiance(1, std::cos(1.0));
  EXPECT_GT(zenith.b, 1.3f * zenith.r);
  const Rgb near_sun = sky.radiance(std::cos(1.0), 0.999), away = sky.radiance(std::cos(1.0), std::cos(2.0));
  EXPECT_GT(luminance(near_sun), 3 * luminance(away));
}

TEST(Sky, DaylightIsFiniteAndNeverNegativeInAnyDirection) {
  for (const double elevation : {0.001, 0.1, 0.8, 1.5707})
    for (const float turbidity : {1.7f, 3.0f, 10.0f}) {
      const SkyLight sky(daylight_scene(elevation, turbidity));
      for (int i = 0; i < 2000; ++i) {
        RandomStream random(3, 1, static_cast<std::uint64_t>(i));
        const DirectionSample s = sky.sample({random.next_float(), random.next_float()});
        const Rgb c = sky.radiance(s.direction);
        EXPECT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
        EXPECT_TRUE(c.r >= 0 && c.g >= 0 && c.b >= 0);
      }
    }
}

TEST(Sky, TheDensityOfDirectionsIntegratesToOneAndIsTheOneReported) {
  const SkyLight sky(daylight_scene(0.5, 3));
  EXPECT_NEAR(integrate_sphere([&](const Vec3& d) { return static_cast<double>(sky.pdf(d)); }, 512), 1,
              0.003);
  int equal = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RandomStream random(3, 2, i);
    const DirectionSample s = sky.sample({random.next_float(), random.next_float()});
    equal += std::abs(s.pdf / sky.pdf(s.direction) - 1) < 1e-3f;
  }
  EXPECT_GE(equal, 995);  // rounding moves a few directions into the cell next door
}

TEST(Sky, SamplingEstimatesTheIntegralOfRadiance) {
  const SkyLight sky(daylight_scene(0.7, 4));
  double sum = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    RandomStream random(8, 2, static_cast<std::uint64_t>(i));
    const DirectionSample s = sky.sample({random.next_float(), random.next_float()});
    sum += static_cast<double>(luminance(sky.radiance(s.direction)) / s.pdf);
  }
  const double expected =
      integrate_sphere([&](const Vec3& d) { return static_cast<double>(luminance(sky.radiance(d))); }, 512);
  EXPECT_NEAR(sum / count / expected, 1, 0.01);
}

TEST(Sky, TheGradientRunsFromHorizonToZenithAndEndsAtTheGround) {
  Scene scene = empty_scene();
  scene.sky.kind = Sky::Kind::kGradient;
  scene.sky.zenith_cd_m2 = {1, 2, 3};
  scene.sky.horizon_cd_m2 = {5, 6, 7};
  scene.sky.ground_cd_m2 = {9, 9, 9};
  const SkyLight sky(scene);
  EXPECT_EQ(sky.radiance({0, 0, 1}), (Rgb{1, 2, 3}));
  EXPECT_EQ(sky.radiance({1, 0, 0}), (Rgb{5, 6, 7}));
  EXPECT_FLOAT_EQ(sky.radiance({std::sqrt(0.75f), 0, 0.5f}).g, 4);
  EXPECT_EQ(sky.radiance({0, 0, -1}), (Rgb{9, 9, 9}));
}

TEST(Sky, ASceneWithoutSkyDoesNotShine) {
  EXPECT_FALSE(SkyLight(empty_scene()).shines());
  EXPECT_TRUE(SkyLight(daylight_scene(0.3, 3)).shines());
}

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

TEST(Portals, GiveTheSameLightAsTheWholeSkyWithLessNoise) {
  const ViewGrid grid = small_grid(6, 4);
  struct Estimate {
    double mean, variance;
  };
  const auto estimate = [&](bool with_portal) {
    const PreparedScene prepared(room_scene(with_portal));
    double sum = 0, squares = 0;
    const int runs = 24;
    for (int i = 0; i < runs; ++i) {
      RenderSettings settings;
      settings.paths_per_pixel = 64;
      settings.seed = static_cast<std::uint64_t>(i);
      const double mean = mean_green(render_view(prepared, grid, {0, 0}, settings).view.colour);
      sum += mean, squares += mean * mean;
    }
    const double mean = sum / runs;
    return Estimate{mean, (squares / runs - mean * mean) / (runs - 1)};
  };
  const Estimate whole = estimate(false), portal = estimate(true);
  // Welch's t; 4.5 standard errors are passed by chance once in 10^4 or less.
  EXPECT_LT(std::abs(whole.mean - portal.mean), 4.5 * std::sqrt(whole.variance + portal.variance));
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

}  // namespace
}  // namespace plenolab::tracer
