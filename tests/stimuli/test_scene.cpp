#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/base/error.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

Scene sound_scene() {
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.5f)};
  scene.meshes = {sphere({0, 3, 0}, 1, 4, 0, true)};
  scene.sun = Sun{};
  scene.sky.kind = Sky::Kind::kDaylight;
  scene.medium = Medium{Vec3(0, 0, 0), Vec3(1, 1, 1), 0.1f, 0.1f, 0};
  return scene;
}

TEST(Scene, ASoundSceneIsAccepted) {
  EXPECT_NO_THROW(validate(sound_scene()));
}

TEST(Scene, EveryFaultIsNamedInAnInputError) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::function<void(Scene&)>> faults = {
      [](Scene& s) { s.meshes[0].material = 1; },
      [](Scene& s) { s.meshes[0].material = -1; },
      [](Scene& s) { s.meshes[0].normals.pop_back(); },
      [](Scene& s) { s.meshes[0].uvs.resize(1); },
      [](Scene& s) { s.meshes[0].triangles[3][1] = 100000; },
      [=](Scene& s) { s.meshes[0].positions_m[2].x() = nan; },
      [=](Scene& s) { s.materials[0].radiance_cd_m2.g = nan; },
      [](Scene& s) { s.materials[0].absorption_per_m.g = -1; },
      [](Scene& s) { s.sun->direction = Vec3(0, 0, 2); },
      [](Scene& s) { s.sun->angular_diameter_deg = 0; },
      [](Scene& s) { s.sun->direction = Vec3(0, 0, -1); },  // daylight needs a risen sun
      [](Scene& s) { s.sun.reset(); },
      [](Scene& s) { s.sky.turbidity = 1; },
      [](Scene& s) { s.sky.ground_cd_m2.b = -1; },
      [](Scene& s) { s.medium->anisotropy = 1; },
      [](Scene& s) { s.medium->min_m.x() = 2; },
      [=](Scene& s) { s.medium->scattering_per_m = nan; },
      [](Scene& s) { s.camera.up = Vec3(0, 1, 0); },
      [](Scene& s) { s.max_bounces = -1; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Scene scene = sound_scene();
    faults[i](scene);
    EXPECT_THROW(validate(scene), InputError) << "fault " << i;
  }
}

}  // namespace
}  // namespace plenolab
