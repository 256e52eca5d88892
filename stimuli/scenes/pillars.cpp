// Pillars (Doronin & Barsi, section 7.1): rows of pillars before, at and behind the screen, three directional
// lights from behind, so that the sides one sees lie in shade and the shadows come towards the observer, and
// surroundings that shine themselves: an evening sky with a glow of 14000 cd/m² behind the middle and a dark
// front of cloud on the left.

#include <array>
#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

constexpr float kFloor_m = -0.17f;

/// Stone with carved rings, whose distance grows with the pillar's so that they show at any depth.
ColourTexture ringed(Rgb light, Rgb dark, float ring_m, std::uint32_t seed) {
  return [=](const SurfacePoint& point) {
    const Vec3& p = point.position_m;
    const float ring = smooth_step(-0.3f, 0.3f, std::sin(6.2831853f * p.z() / ring_m));
    return mix(dark, light, ring) * (0.8f + 0.2f * fractal_noise(p / (1.5f * ring_m), 2, seed));
  };
}

/// Square tiles that fade with distance, before they become finer than the pixels that show them at a grazing
/// angle.
ColourTexture tiles() {
  return [](const SurfacePoint& point) {
    const Vec3& p = point.position_m;
    const int across = static_cast<int>(std::floor(p.x() / 0.12f)),
              along = static_cast<int>(std::floor(p.y() / 0.12f));
    const float tone = cell_random(across, along, 0, 31);
    const Rgb mean{0.36f, 0.33f, 0.30f};
    const Rgb colour = (across + along) % 2 == 0 ? Rgb{0.46f, 0.42f, 0.36f} : Rgb{0.26f, 0.24f, 0.24f};
    const float fade = smooth_step(0.3f, 1.2f, p.head<2>().norm());
    return mix(colour * (0.75f + 0.4f * tone), mean, fade);
  };
}

struct Row {
  float depth_m, radius_m, distance_m, half_width_m;
};
constexpr std::array kRows{Row{-0.35f, 0.012f, 0.19f, 1.0f}, Row{0.05f, 0.020f, 0.17f, 0.7f},
                           Row{0.5f, 0.028f, 0.26f, 2.0f}, Row{1.2f, 0.040f, 0.43f, 4.0f},
                           Row{2.6f, 0.070f, 0.80f, 8.0f}};

void add_row(SceneAssembler& scene, const Row& row, std::uint32_t number) {
  const Rgb light = mix({0.62f, 0.56f, 0.46f}, {0.50f, 0.56f, 0.62f}, static_cast<float>(number) / 4);
  const int stone = scene.material(diffuse(ringed(light, light * 0.45f, row.radius_m * 1.6f, number + 40)));
  RandomStream random(7, 0x70696c6c, number);
  const int last = static_cast<int>(row.half_width_m / row.distance_m);
  for (int i = -last; i <= last; ++i) {
    const float shift = number % 2 == 0 ? 0.5f : 0.0f;
    const float x = row.distance_m * (static_cast<float>(i) + shift + 0.3f * (random.next_float() - 0.5f));
    const float top =
        kFloor_m + (0.26f + 0.12f * random.next_float()) * (1 + 0.5f * std::max(0.0f, row.depth_m));
    scene.add(stone,
              rod({x, row.depth_m, kFloor_m}, {x, row.depth_m, top}, row.radius_m, 0.85f * row.radius_m, 32));
    const float cap = 1.5f * row.radius_m;
    scene.add(stone,
              placed(bevelled_box({2 * cap, 2 * cap, 0.6f * cap}, 0.1f * cap), Vec3(x, row.depth_m, top)));
  }
}

/// Evening sky: brighter towards a glow near the middle, darkened by cloud on the left.
Rgb evening(const Vec3& direction) {
  const Vec3 sun = Vec3(0.12f, 0.99f, 0.06f).normalized();
  const float height = std::max(0.0f, direction.z());
  const float azimuth = std::atan2(direction.x(), direction.y());
  const Rgb sky = mix({900, 620, 420}, {160, 210, 330}, std::min(1.0f, 2.5f * height));
  const float glow = std::exp(-40 * (1 - direction.dot(sun)));
  const float cloud = smooth_step(-0.2f, -0.8f, azimuth + 0.25f * fractal_noise(direction * 4, 3, 51));
  return sky * (1 - 0.93f * cloud) + Rgb{20000, 13000, 7000} * glow;
}

}  // namespace

LitScene build_pillars() {
  SceneAssembler scene;
  for (std::size_t i = 0; i < kRows.size(); ++i) add_row(scene, kRows[i], static_cast<std::uint32_t>(i));
  scene.add(scene.material(diffuse(tiles())),
            surface(2, 2, [](float u, float v) { return Vec3(40 * (2 * u - 1), -1 + 30 * v, kFloor_m); }));
  LitScene result;
  scene.finish(result.scene);
  result.scene.id = "pillars";
  result.scene.title = "Pillars";
  result.scene.description =
      "Pillars before, at and behind the screen, lit from behind by three directional lights, before an "
      "evening sky with a glow of 14000 cd/m²: a typical HDR scene.";
  result.scene.sky = {
      .kind = Sky::Kind::kUniform, .zenith_cd_m2 = {120, 140, 180}, .ground_cd_m2 = {60, 50, 40}};
  result.directions = {
      {.direction = Vec3(0.45f, 0.80f, 0.40f).normalized(), .illuminance_lx = {9000, 7000, 4800}},
      {.direction = Vec3(-0.70f, 0.55f, 0.46f).normalized(), .illuminance_lx = {900, 1100, 1500}},
      {.direction = Vec3(0.05f, 0.60f, 0.80f).normalized(), .illuminance_lx = {1500, 1600, 1900}}};
  result.environment = evening;
  return result;
}

}  // namespace plenolab
