#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/tracer/medium.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

Medium fog(float scattering, float absorption, float anisotropy) {
  return {Vec3(-5, 1, -2), Vec3(5, 7, 3), scattering, absorption, anisotropy};
}

RenderSettings paths(int count) {
  RenderSettings settings;
  settings.paths_per_pixel = count;
  return settings;
}

TEST(Medium, AttenuatesWhatIsSeenThroughItByBeerAndLambert) {
  Scene scene = empty_scene();
  scene.sky = uniform_sky(100, 100);
  scene.medium = fog(0, 0.2f, 0);
  const auto view = render(scene, small_grid(2, 2, 0.1), paths(16)).view;
  EXPECT_NEAR(mean_green(view.colour), 100 * std::exp(-0.2 * 6), 1e-3);
}

TEST(Medium, AttenuatesShadowRays) {
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.5f)};
  scene.meshes = {parallelogram({-4, 2, -1}, {8, 0, 0}, {0, 4, 0}, 0)};
  scene.camera.centre_m = {0, 0, 4};  // outside the medium, looking down to (0, 4, -1)
  scene.camera.forward = Vec3(0, 4, -5).normalized();
  scene.camera.up = Vec3(0, 5, 4).normalized();
  scene.sun = Sun{Vec3(0, 0, 1), 0.53f, {1000, 1000, 1000}};
  scene.medium = fog(0, 0.1f, 0);
  const double slant = std::sqrt(41.0) / 5;  // metres of ray a metre of height
  const double expected = 0.5 / std::numbers::pi * 1000 * std::exp(-0.1 * 4) * std::exp(-0.1 * 4 * slant);
  // The ray enters through the front (y = 1) or the top (z = 3); here the top: at z = 3 it has y = 0.8 < 1,
  // so it enters at y = 1, height 2.75.
  const double entered = 0.5 / std::numbers::pi * 1000 * std::exp(-0.1 * 4) * std::exp(-0.1 * 3.75 * slant);
  EXPECT_LT(expected, entered);
  EXPECT_NEAR(mean_green(render(scene, small_grid(2, 2, 0.05), paths(16)).view.colour), entered,
              1e-3 * entered);
}

TEST(Medium, ScattersSunlightAsTheClosedFormSays) {
  for (const float g : {0.0f, 0.6f}) {
    Scene scene = empty_scene();
    scene.sun = Sun{Vec3(0, 0, 1), 0.53f, {1000, 1000, 1000}};
    scene.medium = fog(0.15f, 0.05f, g);
    const double phase =
        (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g, 1.5));  // light turns by 90°
    const double expected = 0.15 * phase * 1000 * std::exp(-0.2 * 3) * (1 - std::exp(-0.2 * 6)) / 0.2;
    const auto view = render(scene, small_grid(2, 2, 0.1), paths(64)).view;
    EXPECT_NEAR(mean_green(view.colour) / expected, 1, 2e-3) << "g = " << g;
  }
}

TEST(Medium, ScattersForwardTowardsTheSunForPositiveAnisotropy) {
  Scene scene = empty_scene();
  scene.medium = fog(0.1f, 0, 0.8f);
  const auto seen = [&](const Vec3& sun) {
    scene.sun = Sun{sun, 0.53f, {1000, 1000, 1000}};
    return mean_green(render(scene, small_grid(2, 2, 0.1), paths(16)).view.colour);
  };
  EXPECT_GT(seen(Vec3(0, 0.8f, 0.6f)), 5 * seen(Vec3(0, -0.8f, 0.6f)));
}

TEST(Medium, ScattersLampLightAsNumericalQuadratureSays) {
  Scene scene = empty_scene();
  scene.materials = {lamp({1000, 1000, 1000})};
  const float radius = 0.05f;
  scene.meshes = {sphere({0, 4, 0.7f}, radius, 24, 0)};
  scene.medium = fog(0.15f, 0.05f, 0.3f);
  const double intensity = 1000 * std::numbers::pi * static_cast<double>(radius * radius);
  double expected = 0;
  const int steps = 6000;
  for (int i = 0; i < steps; ++i) {
    const double y = 1 + 6 * (i + 0.5) / steps, distance = std::hypot(y - 4, 0.7);
    const double cosine = (4 - y) / distance;  // towards the lamp against the viewing ray
    const double phase = (1 - 0.09) / (4 * std::numbers::pi * std::pow(1 + 0.09 - 2 * 0.3 * cosine, 1.5));
    expected +=
        0.15 * phase * intensity / (distance * distance) * std::exp(-0.2 * (y - 1 + distance)) * 6 / steps;
  }
  const auto view = render(scene, small_grid(8, 8, 0.1), paths(1024)).view;
  EXPECT_NEAR(mean_green(view.colour) / expected, 1, 0.01);
}

TEST(Medium, ThePhaseFunctionIntegratesToOne) {
  for (const float g : {-0.7f, 0.0f, 0.9f}) {
    double sum = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i)
      sum +=
          static_cast<double>(tracer::henyey_greenstein(static_cast<float>(-1 + 2 * (i + 0.5) / steps), g));
    EXPECT_NEAR(sum * 2 / steps * 2 * std::numbers::pi, 1, 1e-3);
  }
}

TEST(Medium, PointsOnASegmentAreDrawnWithTheirReportedDensity) {
  const tracer::MediumSegment segment{1.5f, 7};
  const tracer::Ray ray{Vec3(0, 0, 0), Vec3(0, 1, 0)};
  const int count = 4000;
  double transmitted = 0, equiangular = 0;  // both estimate the length of the segment
  for (int i = 0; i < count; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / count;
    transmitted += 1 / static_cast<double>(sample_transmittance(segment, 0.8f, u).pdf);
    equiangular += 1 / static_cast<double>(sample_equiangular(segment, ray, Vec3(0.3f, 4, 0), u).pdf);
  }
  EXPECT_NEAR(transmitted / count, 5.5, 0.01);
  EXPECT_NEAR(equiangular / count, 5.5, 0.01);
}

TEST(Medium, ALampOnTheRayItselfStaysFinite) {
  const tracer::MediumSegment segment{0, 7};
  const tracer::Ray ray{Vec3(0, 0, 0), Vec3(0, 1, 0)};
  for (const float u : {0.0f, 0.25f, 0.5f, 0.999f}) {
    const auto point = sample_equiangular(segment, ray, Vec3(0, 4, 0), u);
    EXPECT_TRUE(std::isfinite(point.pdf) && point.distance_m >= 0 && point.distance_m <= 7);
  }
}

}  // namespace
}  // namespace plenolab
