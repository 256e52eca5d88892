#include <gtest/gtest.h>

#include "core/image/colour.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

// A horizontal floor far below, filled by the camera that looks straight down at it.
Scene floor_scene(Material material) {
  Scene scene = empty_scene();
  scene.materials = {std::move(material)};
  scene.meshes = {parallelogram({-100, -100, 0}, {200, 0, 0}, {0, 200, 0}, 0)};
  scene.camera.centre_m = {0, 0, 1};
  scene.camera.forward = {0, 0, -1};
  scene.camera.up = {0, 1, 0};
  return scene;
}

RenderSettings paths(int count) {
  RenderSettings settings;
  settings.paths_per_pixel = count;
  return settings;
}

TEST(LightTransport, ADiffuseFloorUnderAUniformSkyShowsAlbedoTimesSky) {
  Scene scene = floor_scene(diffuse(0.6f));
  scene.sky = uniform_sky(200, 0);
  EXPECT_NEAR(mean_green(render(scene, small_grid(), paths(64)).view.colour), 0.6 * 200, 0.6 * 200 * 0.005);
}

TEST(LightTransport, ASphereInAWhiteFurnaceNeverGainsEnergy) {
  struct Case {
    Material::Kind kind;
    float albedo, roughness, lowest;
  };
  // GGX with single scattering loses what bounces between its facets, more the rougher it is.
  for (const Case& c :
       {Case{Material::Kind::kDiffuse, 1, 1, 0.995f}, Case{Material::Kind::kMetal, 1, 0.05f, 0.99f},
        Case{Material::Kind::kMetal, 1, 0.3f, 0.85f}, Case{Material::Kind::kMetal, 1, 1.0f, 0.3f},
        Case{Material::Kind::kGlossy, 1, 0.1f, 0.8f}, Case{Material::Kind::kGlossy, 1, 0.8f, 0.75f},
        Case{Material::Kind::kMirror, 1, 0, 0.9999f}, Case{Material::Kind::kDielectric, 1, 0, 0.97f}}) {
    Scene scene = empty_scene();
    Material m = diffuse(c.albedo);
    m.kind = c.kind;
    m.roughness = constant(c.roughness);
    scene.materials = {m};
    scene.meshes = {sphere({0, 3, 0}, 1, 24, 0)};
    scene.sky = uniform_sky(1, 1);
    scene.max_bounces = 64;
    const double seen = mean_green(render(scene, small_grid(12, 12, 20), paths(64)).view.colour);
    EXPECT_GE(seen, c.lowest) << "kind " << static_cast<int>(c.kind) << " roughness " << c.roughness;
    EXPECT_LE(seen, 1.004) << "kind " << static_cast<int>(c.kind) << " roughness " << c.roughness;
  }
}

TEST(LightTransport, AnIntegratingSphereHasTheClosedFormRadiance) {
  const double albedo = 0.8, radius = 2, lamp_radius = 0.3, lamp_radiance = 1000;
  Scene scene = empty_scene();
  scene.materials = {diffuse(static_cast<float>(albedo)), lamp({1000, 1000, 1000})};
  scene.meshes = {sphere({0, 0, 0}, 2, 48, 0), sphere({0, 0, 0}, 0.3f, 32, 1)};
  scene.camera.centre_m = {0, 1, 0};
  scene.max_bounces = 200;
  // Wall irradiance by the lamp alone; of the light a wall sends out, the share (r/R)² falls on the black
  // lamp.
  const double ratio = lamp_radius * lamp_radius / (radius * radius);
  const double direct = std::numbers::pi * lamp_radiance * ratio;
  const double expected = albedo / std::numbers::pi * direct / (1 - albedo * (1 - ratio));
  EXPECT_NEAR(mean_green(render(scene, small_grid(), paths(256)).view.colour) / expected, 1, 0.02);
}

TEST(LightTransport, TheSunLightsAPlaneByTheCosineLaw) {
  Scene scene = floor_scene(diffuse(0.5f));
  const float elevation = 0.5f;  // radians
  scene.sun = Sun{Vec3(std::cos(elevation), 0, std::sin(elevation)), 0.53f, {100000, 90000, 80000}};
  const auto view = render(scene, small_grid(), paths(16)).view;
  EXPECT_NEAR(mean_green(view.colour), 0.5 / std::numbers::pi * 90000 * std::sin(elevation), 5);
}

TEST(LightTransport, TheSunDiscItselfHasTheRadianceOfItsIlluminance) {
  Scene scene = empty_scene();
  scene.sun = Sun{Vec3(0, 1, 0), 4.0f, {1000, 1000, 1000}};
  const double sine = std::sin(2 * std::numbers::pi / 180);
  const auto view = render(scene, small_grid(3, 3, 3), paths(16)).view;
  EXPECT_NEAR(view.colour.at(1, 1).g / (1000 / (std::numbers::pi * sine * sine)), 1, 1e-4);
}

TEST(LightTransport, ARectangularLampGivesItsAnalyticIrradiance) {
  // A 2 m × 2 m lamp 1.5 m above the point seen; sum of four corner rectangles (Modest, configuration 3).
  Scene scene = floor_scene(diffuse(0.5f));
  scene.materials.push_back(lamp({100, 100, 100}, false));
  scene.meshes.push_back(parallelogram({-1, -1, 1.5f}, {0, 2, 0}, {2, 0, 0}, 1));
  const double a = 1 / 1.5, root = std::sqrt(1 + a * a);
  const double factor = 4 * (1 / (2 * std::numbers::pi)) * 2 * (a / root) * std::atan(a / root);
  const auto view = render(scene, small_grid(2, 2, 1), paths(1024)).view;
  EXPECT_NEAR(mean_green(view.colour) / (0.5 * 100 * factor), 1, 0.01);
}

TEST(LightTransport, AOneSidedLampIsBlackFromBehind) {
  Scene scene = floor_scene(diffuse(0.5f));
  scene.materials.push_back(lamp({100, 100, 100}, false));
  scene.meshes.push_back(parallelogram({-1, -1, 1.5f}, {2, 0, 0}, {0, 2, 0}, 1));
  EXPECT_EQ(mean_green(render(scene, small_grid(2, 2, 1), paths(64)).view.colour), 0);
}

}  // namespace
}  // namespace plenolab
