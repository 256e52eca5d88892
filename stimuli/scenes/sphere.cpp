// Sphere (Doronin & Barsi, section 7.1): a sphere in the void, lit by three point lights of 1000, 1 and 1 cd.
// The strong one, on the right, stands a little behind the sphere: from the right one sees the lit side, from
// the left almost only what the weak lamps show, about a thousandth of it.

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

/// Bands of latitude and blotches, fine enough to show blur.
ColourTexture ball_colours() {
  return [](const SurfacePoint& point) {
    const Vec3& p = point.position_m;
    const float band = smooth_step(-0.2f, 0.2f, std::sin(p.z() * 140));
    const float blotch = fractal_noise(p / 0.035f, 3, 21);
    return mix(Rgb{0.62f, 0.34f, 0.20f}, Rgb{0.72f, 0.68f, 0.58f}, band) * (0.75f + 0.25f * blotch);
  };
}

}  // namespace

LitScene build_sphere() {
  SceneAssembler scene;
  scene.add(scene.material(diffuse(ball_colours())), ellipsoid({0.15f, 0.15f, 0.15f}, 192));
  LitScene result;
  scene.finish(result.scene);
  result.scene.id = "sphere";
  result.scene.title = "Sphere";
  result.scene.description =
      "A sphere in the void lit by 1000 cd from the right and 1 cd from the middle and the left: its "
      "luminance changes drastically along the observer line.";
  result.points = {{.position_m = {-1.2f, -0.6f, 0.15f}, .intensity_cd = {1, 1, 1}},
                   {.position_m = {0, -1.2f, 0.1f}, .intensity_cd = {1, 1, 1}},
                   {.position_m = {1.2f, 0.5f, 0.4f}, .intensity_cd = {1000, 1000, 1000}}};
  return result;
}

}  // namespace plenolab
