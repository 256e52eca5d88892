// Near-eye 4, curved surfaces: a chequered globe and a rippled, printed cloth behind it. Depth changes
// smoothly within each subimage and texture tells every misplaced pixel; depth edges are few.

#include <cmath>
#include <numbers>

#include "stimuli/scenes/modelling/near_eye.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

/// Chequers over longitude and latitude, with soft edges and a mottled tone.
Rgb globe_colour(const SurfacePoint& point) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  const float a = std::sin(kTurn * 12 * point.u) * std::sin(kTurn * 6 * point.v);
  const float tone = 0.85f + 0.15f * fractal_noise(point.position_m / 0.012f, 2, 41);
  return mix({0.16f, 0.24f, 0.40f}, {0.72f, 0.62f, 0.40f}, smooth_step(-0.2f, 0.2f, a)) * tone;
}

/// Printed rings on the cloth, which is parametrised in metres.
Rgb cloth_colour(const SurfacePoint& point) {
  const float u = point.u / 0.09f, v = point.v / 0.09f;
  const float x = u - std::floor(u) - 0.5f, y = v - std::floor(v) - 0.5f;
  const float ring = std::abs(std::hypot(x, y) - 0.3f);
  const float tone = 0.9f + 0.1f * fractal_noise({point.u / 0.03f, point.v / 0.03f, 0}, 2, 42);
  return mix({0.60f, 0.16f, 0.14f}, {0.66f, 0.62f, 0.55f}, smooth_step(0.08f, 0.14f, ring)) * tone;
}

}  // namespace

Scene build_near_eye_4() {
  SceneAssembler scene;
  add_surroundings(scene, -0.5f, {0.46f, 0.48f, 0.40f}, {0.38f, 0.30f, 0.24f}, 34);
  const int globe = scene.material(diffuse(globe_colour)), cloth = scene.material(diffuse(cloth_colour));
  scene.add(globe, placed(ellipsoid({0.075f, 0.075f, 0.075f}, 96), Vec3(-0.01f, 0.7f, -0.01f)));
  scene.add(cloth, surface(220, 160,
                           [](float u, float v) {
                             const float x = 1.1f * (u - 0.5f), z = 0.8f * (v - 0.5f);
                             return Vec3(
                                 x, 1.7f + 0.09f * std::sin(14 * x) + 0.04f * std::sin(17 * z + 3 * x), z);
                           },
                           {1.1f, 0.8f}));
  return finish_near_eye(
      scene, "near-eye-4", "Curved surfaces",
      "A chequered globe before a rippled, printed cloth: depth changes smoothly under fine "
      "texture, and depth edges are few.");
}

}  // namespace plenolab
