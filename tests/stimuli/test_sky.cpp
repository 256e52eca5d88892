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

}  // namespace
}  // namespace plenolab::tracer
