// Near-eye 5, extreme occlusion: a row of rods 12 cm from the cameras, before objects at 1 m and a wall at 6
// m. From the left to the right corner cameras rods move by 54 px, about the distance from one to the next:
// what the middle cameras see between two rods is behind a rod in all corner cameras.

#include "stimuli/scenes/modelling/near_eye.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

Scene build_near_eye_5() {
  SceneAssembler scene;
  constexpr float kNear = 0.12f, kFloor = -0.4f;
  add_surroundings(scene, kFloor, {0.54f, 0.50f, 0.40f}, {0.34f, 0.30f, 0.28f}, 35);
  const int wood = add_mottled(scene, {0.50f, 0.34f, 0.18f}, {0.28f, 0.17f, 0.09f}, kNear, 8, 51);
  const int green = add_mottled(scene, {0.22f, 0.46f, 0.20f}, {0.10f, 0.26f, 0.10f}, 0.9f, 8, 52);
  const int violet = add_mottled(scene, {0.46f, 0.24f, 0.52f}, {0.28f, 0.12f, 0.32f}, 1.3f, 8, 53);
  const float half = half_extent_m(kNear);
  for (const float x : {-1.86f, -1.24f, -0.62f, 0.0f, 0.62f, 1.24f, 1.86f})
    scene.add(wood, rod({(x - 0.05f) * half, kNear + 0.002f, -1.8f * half},
                        {(x + 0.05f) * half, kNear + 0.002f, 1.8f * half}, 0.002f, 0.0018f, 40));
  scene.add(wood, rod({-2 * half, kNear + 0.0055f, -0.66f * half}, {2 * half, kNear + 0.0055f, -0.6f * half},
                      0.0012f, 0.0012f, 32));
  scene.add(green, placed(ellipsoid({0.07f, 0.07f, 0.07f}, 64), Vec3(-0.06f, 0.9f, 0.01f)));
  scene.add(violet, placed(bevelled_box({0.16f, 0.14f, 0.24f}, 0.012f), pose({0.12f, 1.3f, -0.06f}, 35)));
  return finish_near_eye(
      scene, "near-eye-5", "Extreme occlusion",
      "Rods 12 cm from the cameras move by their distance over the array: what the middle cameras "
      "see between them is hidden from all corner cameras.");
}

}  // namespace plenolab
