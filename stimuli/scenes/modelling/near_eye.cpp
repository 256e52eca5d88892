#include "stimuli/scenes/modelling/near_eye.h"

#include <cmath>
#include <numbers>

#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {

namespace {

constexpr float kFovDeg = 19.86f, kWall_m = 6, kPixels = 162;

/// Wallpaper of rhombs over mottled plaster.
ColourTexture wallpaper(Rgb colour, std::uint32_t seed) {
  return [colour, seed](const SurfacePoint& point) {
    const float x = point.position_m.x() / 0.16f, z = point.position_m.z() / 0.22f;
    const float a =
        std::sin(std::numbers::pi_v<float> * (x + z)) * std::sin(std::numbers::pi_v<float> * (x - z));
    const float blotch = 0.82f + 0.18f * fractal_noise(point.position_m / 0.3f, 2, seed);
    return colour * (blotch * (0.62f + 0.38f * smooth_step(-0.25f, 0.25f, a)));
  };
}

/// Boards across, wider with distance only as far as they are seen: tones differ from board to board.
ColourTexture boards(Rgb colour, std::uint32_t seed) {
  return [colour, seed](const SurfacePoint& point) {
    const float board = point.position_m.x() / 0.11f;
    const float tone = cell_random(static_cast<int>(std::floor(board)), 0, 0, seed);
    const float grain = fractal_noise({board * 4, point.position_m.y() * 1.5f, 0}, 2, seed);
    return colour * (0.6f + 0.3f * tone + 0.1f * grain);
  };
}

}  // namespace

float half_extent_m(float distance_m) {
  return distance_m * std::tan(kFovDeg * std::numbers::pi_v<float> / 360);
}

int add_mottled(SceneAssembler& scene, Rgb base, Rgb stain, float distance_m, float features_px,
                std::uint32_t seed) {
  const float pixel_m = 2 * half_extent_m(distance_m) / kPixels;
  return scene.material(diffuse(mottled(base, stain, features_px * pixel_m, 0, seed)));
}

void add_surroundings(SceneAssembler& scene, float floor_z_m, Rgb wall, Rgb floor, std::uint32_t seed) {
  const float reach = 1.5f * half_extent_m(kWall_m);
  scene.add(scene.material(diffuse(wallpaper(wall, seed))), surface(60, 60, [=](float u, float v) {
              return Vec3(reach * (2 * u - 1), kWall_m, floor_z_m + (reach - floor_z_m) * v);
            }));
  scene.add(scene.material(diffuse(boards(floor, seed))), surface(60, 60, [=](float u, float v) {
              return Vec3(reach * (2 * u - 1), kWall_m * v, floor_z_m);
            }));
}

Scene finish_near_eye(SceneAssembler& scene, const char* id, const char* title, const char* description) {
  Scene result;
  scene.finish(result);
  result.id = id;
  result.title = title;
  result.description = description;
  result.sun =
      Sun{.direction = Vec3(-0.45f, -0.55f, 0.7f).normalized(), .illuminance_lx = {2200, 2050, 1850}};
  result.sky = {.kind = Sky::Kind::kUniform,
                .zenith_cd_m2 = {150, 162, 180},
                .horizon_cd_m2 = {150, 162, 180},
                .ground_cd_m2 = {80, 75, 70}};
  result.camera = camera_along_y({0, 0, 0}, kFovDeg);
  result.quick = result.paper = {.columns = 15,
                                 .rows = 8,
                                 .spacing_x_m = 0.001,
                                 .spacing_y_m = 0.001,
                                 .width = 162,
                                 .height = 162,
                                 .paths_per_pixel = 16};
  result.max_bounces = 2;
  return result;
}

}  // namespace plenolab
