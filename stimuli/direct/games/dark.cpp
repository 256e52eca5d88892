// Game-like scenes at night and underground.

#include <cmath>
#include <numbers>

#include "stimuli/direct/games/builder.h"
#include "stimuli/direct/games/scenes.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

namespace {

/// A winding tunnel along y, floor near z = 0, rock pushed about by noise.
Mesh cave(std::uint32_t seed) {
  return surface(96, 160, [seed](float u, float v) {
    const float angle = 2 * std::numbers::pi_v<float> * u, y = 36 * v - 4;
    const Vec3 out(std::cos(angle), 0, std::sin(angle));
    const float radius = 2.6f + 0.7f * fractal_noise(Vec3(1.1f * out.x(), y / 2.5f, 1.1f * out.z()), 3, seed);
    const Vec3 middle(1.5f * std::sin(0.25f * y), y, 1.6f);
    const Vec3 wall = middle + radius * out;
    return Vec3(wall.x(), wall.y(), std::max(wall.z(), -0.2f));
  });
}

/// Stones on the floor of a cave and teeth on its ceiling.
void add_stones(GameBuilder& scene, int material, std::uint32_t seed) {
  for (int i = 0; i < 14; ++i) {
    const float y = 1.5f + 2 * static_cast<float>(i), size = 0.3f + 0.5f * cell_random(i, 0, 0, seed);
    const float x = 1.5f * std::sin(0.25f * y) + 2.6f * (cell_random(i, 1, 0, seed) - 0.5f);
    scene.part(material, placed(rough_stone({size, 1.2f * size, 1.4f * size}, 0.3f * size, 0.1f * size, 8,
                                            seed + static_cast<std::uint32_t>(i)),
                                Vec3(x, y, 0.2f)));
    scene.column(material, {x + 0.8f, y + 1, 2.6f}, 0.12f, 1.8f);
  }
}

GameScene gallery(const char* id, float wall, Rgb ambient, Rgb lamps_cd, GameCamera first, GameCamera last) {
  GameBuilder scene;
  const int white = scene.matte({wall, wall, 0.95f * wall}), stone = scene.matte({0.30f, 0.28f, 0.26f}),
            bronze = scene.polished({0.16f, 0.11f, 0.06f}, 2.0f), red = scene.matte({0.40f, 0.10f, 0.08f});
  scene.room({-5, -2, 0}, {5, 18, 4}, scene.polished({0.12f, 0.10f, 0.09f}, 1.8f), white,
             scene.matte({0.25f, 0.25f, 0.25f}));
  for (int i = 0; i < 4; ++i) {
    const float y = 2 + 4 * static_cast<float>(i);
    for (const float x : {-3.4f, 3.4f}) {
      scene.block(stone, {x, y, 0.5f}, {0.8f, 0.8f, 1.0f});
      scene.ball(bronze, {x, y, 1.45f}, 0.45f);
    }
    scene.block(red, {i % 2 == 0 ? -4.95f : 4.95f, y + 2, 1.9f}, {0.06f, 2.2f, 1.3f});
    scene.lamp({0, y, 3.6f}, lamps_cd);
  }
  scene.block(stone, {0.6f, 9, 0.25f}, {0.7f, 2.4f, 0.5f}, 20);
  scene.ambient(ambient, ambient * 0.5f);
  return scene.finish(id, {}, first, last);
}

}  // namespace

GameScene build_reflections() {
  GameBuilder scene;
  const int wet = scene.polished({0.05f, 0.05f, 0.055f}, 1.6f), brick = scene.matte({0.16f, 0.10f, 0.08f}),
            plaster = scene.matte({0.24f, 0.23f, 0.21f}), bin = scene.matte({0.07f, 0.12f, 0.09f});
  scene.block(wet, {0, 15, -0.15f}, {60, 60, 0.3f});
  const Rgb signs[]{{1800, 120, 700}, {90, 900, 1500}, {2600, 1500, 300}};
  for (int i = 0; i < 6; ++i) {
    const float y = 3 + 5 * static_cast<float>(i), side = i % 2 == 0 ? -1.0f : 1.0f;
    scene.block(brick, {-6.2f, y, 3.5f}, {4, 4.7f, 7});
    scene.block(plaster, {6.2f, y, 3}, {4, 4.4f, 6 + static_cast<float>(i % 3)});
    scene.block(scene.shining(signs[i % 3]), {side * 4.1f, y, 2.4f}, {0.12f, 1.6f, 0.7f});
    scene.lamp({side * 3.6f, y, 2.4f}, signs[i % 3] * 0.03f);
    scene.block(bin, {-side * 3.5f, y + 1.3f, 0.5f}, {0.8f, 1.1f, 1.0f});
  }
  scene.ambient({0.05f, 0.06f, 0.09f}, {0.03f, 0.03f, 0.03f});
  return scene.finish("after-reflections", open_sky({0.02f, 0.03f, 0.06f}, {0.15f, 0.13f, 0.16f}),
                      {{-1, -3, 1.6f}, {0.5f, 12, 1.8f}}, {{0.8f, 3, 1.6f}, {-1, 18, 1.8f}});
}

GameScene build_effects_cave_2() {
  GameBuilder scene;
  const int rock = scene.matte({0.22f, 0.18f, 0.15f});
  scene.part(rock, cave(71));
  add_stones(scene, scene.matte({0.30f, 0.26f, 0.22f}), 72);
  const int fire = scene.shining({4200, 1500, 260}), crystal = scene.shining({60, 320, 520});
  for (const float y : {6.0f, 14.0f, 23.0f}) {
    const float x = 1.5f * std::sin(0.25f * y) - 0.9f;
    scene.ball(fire, {x, y, 0.45f}, 0.28f);
    scene.lamp({x, y, 1.0f}, {160, 62, 14});
    scene.ball(crystal, {x + 2, y + 3, 2.2f}, 0.22f);
    scene.lamp({x + 1.6f, y + 3, 2.0f}, {1.5f, 7, 11});
  }
  scene.ambient({0.03f, 0.03f, 0.04f}, {0.02f, 0.02f, 0.02f});
  return scene.finish("after-effects-cave-2", open_sky({0.02f, 0.02f, 0.03f}, {0.01f, 0.01f, 0.01f}),
                      {{0, 0, 1.5f}, {1.4f, 7, 1.3f}}, {{1.1f, 3.2f, 1.5f}, {0.6f, 11, 1.3f}});
}

GameScene build_effects_cave() {
  GameBuilder scene;
  scene.part(scene.matte({0.26f, 0.25f, 0.27f}), cave(81));
  add_stones(scene, scene.matte({0.36f, 0.33f, 0.30f}), 82);
  const int chest = scene.matte({0.28f, 0.16f, 0.08f});
  scene.block(chest, {1.6f, 6.5f, 0.3f}, {0.9f, 0.6f, 0.6f}, 25);
  scene.block(chest, {0.4f, 9.5f, 0.3f}, {0.7f, 0.7f, 0.7f}, -15);
  for (const float y : {4.0f, 10.0f, 17.0f}) scene.lamp({1.5f * std::sin(0.25f * y), y, 2.6f}, {30, 36, 46});
  scene.ambient({0.9f, 1.0f, 1.2f}, {0.45f, 0.4f, 0.4f});
  return scene.finish("after-effects-cave", open_sky({0.2f, 0.2f, 0.3f}, {0.1f, 0.1f, 0.1f}),
                      {{0, 0, 1.5f}, {1.4f, 7, 1.3f}}, {{1.1f, 3, 1.6f}, {0.8f, 11, 1.2f}});
}

GameScene build_realistic_reflections() {
  return gallery("after-realistic-reflections", 0.55f, {1.6f, 1.6f, 1.8f}, {60, 52, 40},
                 {{-2.5f, -1.2f, 1.6f}, {1, 10, 1.3f}}, {{0.5f, 0.8f, 1.6f}, {-1, 12, 1.3f}});
}

GameScene build_realistic_reflections_2() {
  return gallery("after-realistic-reflections-2", 0.32f, {0.7f, 0.8f, 1.1f}, {28, 34, 44},
                 {{3.2f, 16, 1.2f}, {-2, 6, 1.0f}}, {{1.0f, 15, 1.9f}, {-2.5f, 4, 0.8f}});
}

GameScene build_temple() {
  GameBuilder scene;
  const int marble = scene.matte({0.48f, 0.46f, 0.42f}),
            step = scene.tiles({0.34f, 0.33f, 0.31f}, {0.26f, 0.25f, 0.24f}, 1.2f),
            moss = scene.matte({0.10f, 0.15f, 0.07f});
  scene.block(step, {0, 12, -0.15f}, {50, 60, 0.3f});
  for (int i = 0; i < 7; ++i)
    for (const float x : {-3.5f, 3.5f}) {
      const float y = 2 + 3.2f * static_cast<float>(i);
      scene.column(marble, {x, y, 0}, 0.45f, 4.5f);
      scene.block(marble, {x, y, 4.65f}, {1.3f, 1.3f, 0.3f});
      scene.block(moss, {1.6f * x, y + 1.6f, 0.35f}, {1.2f, 1.0f, 0.7f}, 30);
    }
  for (const float x : {-3.5f, 3.5f}) scene.block(marble, {x, 11.6f, 5.1f}, {1.0f, 22, 0.6f});
  scene.block(marble, {0, 25, 3}, {12, 1, 6});
  scene.block(marble, {0, 20, 0.6f}, {2.2f, 1.2f, 1.2f});
  scene.ball(scene.polished({0.14f, 0.20f, 0.17f}, 1.8f), {0, 20, 1.8f}, 0.6f);
  scene.distant({0.6f, -0.4f, 0.8f}, {9, 10, 13});
  scene.ambient({1.0f, 1.2f, 1.7f}, {0.5f, 0.5f, 0.5f});
  return scene.finish("after-temple", open_sky({0.5f, 0.7f, 1.3f}, {2.2f, 2.0f, 2.2f}),
                      {{-1.4f, -3, 1.7f}, {0.3f, 14, 2.0f}}, {{0.9f, 1.5f, 1.7f}, {-0.3f, 18, 2.2f}});
}

}  // namespace plenolab
