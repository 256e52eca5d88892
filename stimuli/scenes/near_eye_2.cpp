// Near-eye 2, few objects: a large ball, a jar-like block and a slab stand well apart between 0.6 m and 2.5
// m, and most of every subimage is floor and wall, which all cameras see.

#include "stimuli/scenes/modelling/near_eye.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

Scene build_near_eye_2() {
  SceneAssembler scene;
  constexpr float kFloor = -0.32f;
  add_surroundings(scene, kFloor, {0.42f, 0.52f, 0.56f}, {0.40f, 0.34f, 0.30f}, 32);
  const int red = add_mottled(scene, {0.66f, 0.20f, 0.13f}, {0.46f, 0.10f, 0.08f}, 1, 9, 1);
  const int blue = add_mottled(scene, {0.16f, 0.32f, 0.58f}, {0.09f, 0.18f, 0.38f}, 1.8f, 9, 2);
  const int sand = add_mottled(scene, {0.70f, 0.62f, 0.44f}, {0.52f, 0.43f, 0.28f}, 0.62f, 9, 3);
  scene.add(red, placed(ellipsoid({0.11f, 0.11f, 0.11f}, 80), Vec3(0.05f, 1, -0.02f)));
  scene.add(blue, placed(bevelled_box({0.22f, 0.22f, 0.5f}, 0.02f), pose({-0.2f, 1.8f, kFloor + 0.25f}, 28)));
  scene.add(sand, placed(bevelled_box({0.09f, 0.06f, 0.05f}, 0.006f), pose({-0.025f, 0.62f, -0.085f}, -20)));
  return finish_near_eye(
      scene, "near-eye-2", "Few objects",
      "Three objects well apart between 0.6 m and 2.5 m: most of every subimage is floor and "
      "wall that all cameras see.");
}

}  // namespace plenolab
