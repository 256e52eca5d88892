#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "stimuli/direct/lit_scene.h"
#include "stimuli/scenes/table.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

constexpr double kPi = std::numbers::pi;

/// A wall of albedo ½ at y = 2 m that faces the origin.
LitScene wall() {
  LitScene lit;
  lit.scene.materials = {testing::diffuse(0.5f)};
  lit.scene.meshes = {testing::parallelogram({-5, 2, -5}, {10, 0, 0}, {0, 0, 10}, 0)};
  return lit;
}

float ahead(const LitScene& scene) {
  return LitRays(scene).radiance({0, 0, 0}, {0, 1, 0}).g;
}

TEST(LitScene, PointLightsFollowTheInverseSquareAndTheCosine) {
  LitScene scene = wall();
  scene.points = {{.position_m = {0, 0, 0}, .intensity_cd = {100, 100, 100}}};
  EXPECT_NEAR(static_cast<double>(ahead(scene)), 0.5 / kPi * 100 / 4, 1e-3);
  scene.points[0].position_m = {0, 0, 2};  // 2 m up: √8 m away at 45°
  EXPECT_NEAR(static_cast<double>(ahead(scene)), 0.5 / kPi * 100 / 8 * std::sqrt(0.5), 1e-3);
}

TEST(LitScene, LightsAddUpAndShineOnTheFrontOnly) {
  LitScene scene = wall();
  scene.directions = {{.direction = {0, -1, 0}, .illuminance_lx = {30, 30, 30}},
                      {.direction = {0, 1, 0}, .illuminance_lx = {1e6f, 1e6f, 1e6f}}};
  scene.points = {{.position_m = {0, 0, 0}, .intensity_cd = {100, 100, 100}}};
  scene.scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = {8, 8, 8}, .ground_cd_m2 = {4, 4, 4}};
  EXPECT_NEAR(static_cast<double>(ahead(scene)), 0.5 / kPi * (30 + 25) + 0.5 * 6, 1e-3);
}

TEST(LitScene, LampsBehindSomethingCastShadows) {
  LitScene scene = wall();
  scene.points = {{.position_m = {0, 0, 3}, .intensity_cd = {100, 100, 100}}};
  scene.scene.meshes.push_back(testing::parallelogram({-1, 0.8f, 1}, {2, 0, 0}, {0, 0.6f, 0}, 0));
  EXPECT_EQ(ahead(scene), 0);
}

TEST(LitScene, ShowsItsSurroundingsBehindEverything) {
  LitScene scene = wall();
  EXPECT_EQ(LitRays(scene).radiance({0, 0, 0}, {0, -1, 0}), Rgb{});
  scene.environment = [](const Vec3& direction) { return Rgb{1, 2, 3} * -direction.y(); };
  EXPECT_EQ(LitRays(scene).radiance({0, 0, 0}, {0, -1, 0}), (Rgb{1, 2, 3}));
}

TEST(LitScene, RefusesDirectionsThatAreNoUnitVectors) {
  LitScene scene = wall();
  scene.directions = {{.direction = {0, -2, 0}}};
  EXPECT_THROW(LitRays{scene}, InputError);
}

TEST(DisplayScenes, AreFoundByTheirIdsAndTheSameAtEveryCall) {
  std::set<std::string> ids;
  for (const SceneEntry& entry : scenes()) ids.insert(entry.id);
  for (const LitSceneEntry& entry : display_scenes()) {
    EXPECT_TRUE(ids.insert(entry.id).second) << entry.id;
    const LitScene scene = build_display_scene(entry.id);
    EXPECT_EQ(scene.scene.id, entry.id);
    EXPECT_EQ(scene.scene.title, entry.title);
    EXPECT_GT(scene.scene.description.size(), 40u);
    const LitRays first(scene), second(entry.build());
    for (int i = -5; i <= 5; ++i) {
      const Vec3 from(static_cast<float>(i), -2, 0), to(0.02f * static_cast<float>(i), 0, 0.03f);
      EXPECT_EQ(first.radiance(from, (to - from).normalized()),
                second.radiance(from, (to - from).normalized()));
    }
  }
  EXPECT_THROW(build_display_scene("cube"), InputError);
}

TEST(DisplayScenes, SphereIsAThousandTimesBrighterOnItsRightSide) {
  const LitRays sphere(build_display_scene("sphere"));
  const auto from = [&](float x) {
    const Vec3 eye(x, -2, 0);
    return luminance(sphere.radiance(eye, -eye.normalized()));
  };
  EXPECT_GT(from(4.5f), 200 * from(-4.5f));
  EXPECT_GT(from(-4.5f), 1e-3f) << "the weak lamps show it from the left";
  EXPECT_EQ(luminance(sphere.radiance({0, -2, 0}, Vec3(0.2f, 1, 0).normalized())), 0) << "in the void";
}

TEST(DisplayScenes, PillarsSpanThreeOrdersOfMagnitudeFromTheCentre) {
  const LitRays pillars(build_display_scene("pillars"));
  float low = 1e9f, high = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 eye(0, -2, 0);
    const Vec3 point(0.6f * (static_cast<float>(i % 20) / 19 - 0.5f), 0,
                     0.3f * (static_cast<float>(i / 20) / 19 - 0.5f));
    const float l = luminance(pillars.radiance(eye, (point - eye).normalized()));
    low = std::min(low, l), high = std::max(high, l);
  }
  EXPECT_GT(low, 0);
  EXPECT_GT(high, 1000 * low);
}

}  // namespace
}  // namespace plenolab
