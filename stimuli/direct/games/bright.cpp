// Game-like scenes by day and in lit rooms.

#include "stimuli/direct/games/builder.h"
#include "stimuli/direct/games/scenes.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

namespace {

void add_car(GameBuilder& scene, int paint, const Vec3& at, float yaw_deg) {
  const int rubber = scene.matte({0.05f, 0.05f, 0.05f}), glass = scene.polished({0.06f, 0.07f, 0.08f}, 1.7f);
  const auto place = [&](const Vec3& p) -> Vec3 { return pose(at, yaw_deg) * p; };
  scene.block(paint, place({0, 0, 0.65f}), {1.8f, 4.0f, 0.6f}, yaw_deg);
  scene.block(glass, place({0, -0.2f, 1.2f}), {1.5f, 1.9f, 0.55f}, yaw_deg);
  for (const float x : {-0.85f, 0.85f})
    for (const float y : {-1.3f, 1.3f}) scene.ball(rubber, place({x, y, 0.36f}), 0.36f);
}

void add_sofa(GameBuilder& scene, int cloth, const Vec3& at, float yaw_deg) {
  const auto place = [&](const Vec3& p) -> Vec3 { return pose(at, yaw_deg) * p; };
  scene.block(cloth, place({0, 0, 0.25f}), {2.1f, 0.9f, 0.5f}, yaw_deg);
  scene.block(cloth, place({0, 0.4f, 0.65f}), {2.1f, 0.2f, 0.7f}, yaw_deg);
  for (const float x : {-1.0f, 1.0f}) scene.block(cloth, place({x, 0, 0.4f}), {0.2f, 0.9f, 0.7f}, yaw_deg);
}

}  // namespace

GameScene build_sun_temple() {
  GameBuilder scene;
  const int sand = scene.matte({0.45f, 0.36f, 0.24f}), gold = scene.polished({0.30f, 0.20f, 0.06f}, 2.2f),
            slab = scene.tiles({0.40f, 0.33f, 0.24f}, {0.28f, 0.22f, 0.16f}, 1.0f),
            shade = scene.matte({0.07f, 0.05f, 0.04f});
  scene.block(slab, {0, 14, -0.15f}, {14, 44, 0.3f});
  scene.block(sand, {-6.8f, 14, 4}, {0.6f, 44, 8});
  scene.block(sand, {0, 32, 4}, {14, 0.6f, 8});
  scene.block(shade, {-2.2f, 12, 7.9f}, {9.5f, 40, 0.4f});  // roof, open on the right
  for (int i = 0; i < 8; ++i) {
    const float y = 1 + 4 * static_cast<float>(i);
    for (const float x : {-4.2f, 4.2f}) {
      scene.column(sand, {x, y, 0}, 0.6f, 7.8f);
      scene.block(gold, {x, y, 0.3f}, {1.6f, 1.6f, 0.6f});
    }
    scene.block(shade, {-6.4f, y + 2, 1.5f}, {0.3f, 1.4f, 3.0f});
  }
  scene.ball(gold, {0, 26, 2.4f}, 1.4f);
  scene.distant({0.75f, -0.15f, 0.62f}, {88000, 80000, 66000});
  scene.ambient({70, 66, 60}, {120, 100, 75});
  return scene.finish("after-sun-temple", open_sky({2600, 4200, 7500}, {9000, 9500, 10000}),
                      {{-2.2f, -3.5f, 1.7f}, {1, 16, 2.6f}}, {{-0.6f, 1.5f, 1.7f}, {0, 20, 2.6f}});
}

GameScene build_research_lab() {
  GameBuilder scene;
  const int white = scene.matte({0.72f, 0.73f, 0.74f}), steel = scene.polished({0.35f, 0.36f, 0.38f}, 2.0f),
            dark = scene.matte({0.030f, 0.032f, 0.036f}), orange = scene.matte({0.65f, 0.26f, 0.05f});
  scene.room({-4.5f, -3, 0}, {4.5f, 17, 3.2f}, scene.polished({0.40f, 0.41f, 0.43f}, 1.5f), white, white);
  const int panel = scene.shining({9500, 9800, 10000}), screen = scene.shining({120, 320, 420});
  for (int i = 0; i < 4; ++i) {
    const float y = 1 + 4.2f * static_cast<float>(i);
    for (const float x : {-2.0f, 2.0f}) scene.block(panel, {x, y, 3.17f}, {0.5f, 1.6f, 0.06f});
    scene.lamp({0, y, 2.9f}, {420, 430, 450});
    scene.block(dark, {-4.1f, y + 1.6f, 1.1f}, {0.8f, 2.2f, 2.2f});
    scene.block(dark, {4.1f, y + 0.6f, 1.0f}, {0.8f, 1.7f, 2.0f});
    scene.block(steel, {1.9f, y + 2, 0.45f}, {1.2f, 2.0f, 0.9f});
    scene.block(screen, {1.9f, y + 2, 1.2f}, {0.7f, 0.06f, 0.45f});
    scene.block(orange, {-1.7f, y + 1.2f, 0.4f}, {0.7f, 0.7f, 0.8f}, 15);
  }
  scene.ambient({80, 83, 88}, {60, 60, 62});
  return scene.finish("after-research-lab", {}, {{-0.6f, -2, 1.6f}, {0.4f, 12, 1.4f}},
                      {{0.3f, 1.2f, 1.6f}, {-0.8f, 14, 1.4f}});
}

GameScene build_vehicle_game() {
  GameBuilder scene;
  const int sand = scene.matte({0.42f, 0.34f, 0.24f}), asphalt = scene.matte({0.16f, 0.16f, 0.17f}),
            ramp = scene.matte({0.50f, 0.48f, 0.45f}), line = scene.matte({0.70f, 0.70f, 0.66f}),
            rock = scene.matte({0.34f, 0.24f, 0.17f});
  scene.block(sand, {0, 80, -0.5f}, {400, 400, 0.9f});
  scene.block(asphalt, {0, 80, -0.04f}, {11, 400, 0.08f});
  for (int i = 0; i < 24; ++i)
    scene.block(line, {0, -4 + 5 * static_cast<float>(i), 0.01f}, {0.25f, 2.2f, 0.03f});
  for (int i = 0; i < 9; ++i) {
    const float y = 12 + 14 * static_cast<float>(i), side = i % 2 == 0 ? -1.0f : 1.0f;
    scene.block(ramp, {side * 8, y, 0.6f}, {3, 6, 1.2f}, 12 * side);
    scene.part(rock, placed(rough_stone({9, 8, 6 + static_cast<float>(i % 3)}, 1.5f, 0.9f, 12,
                                        static_cast<std::uint32_t>(90 + i)),
                            Vec3(-side * (19 + static_cast<float>(i)), y + 4, 1.5f)));
  }
  add_car(scene, scene.matte({0.55f, 0.06f, 0.05f}), {1.8f, 7, 0}, -4);
  add_car(scene, scene.matte({0.08f, 0.20f, 0.50f}), {-2.4f, 16, 0}, 6);
  scene.distant({-0.5f, -0.35f, 0.75f}, {52000, 49000, 43000});
  scene.ambient({9000, 10500, 13000}, {5200, 4400, 3300});
  return scene.finish("after-vehicle-game", open_sky({5500, 7500, 11500}, {12000, 12500, 13000}),
                      {{0.5f, -1, 2.4f}, {0, 14, 1.2f}}, {{0.2f, 3.5f, 2.2f}, {-0.6f, 18, 1.2f}});
}

GameScene build_living_room() {
  GameBuilder scene;
  const int wall = scene.matte({0.66f, 0.62f, 0.55f}), wood = scene.matte({0.36f, 0.22f, 0.12f}),
            cloth = scene.matte({0.30f, 0.34f, 0.40f}), set = scene.matte({0.09f, 0.09f, 0.09f}),
            plant = scene.matte({0.16f, 0.30f, 0.10f}), picture = scene.matte({0.52f, 0.20f, 0.14f});
  scene.room({-3.5f, -2.5f, 0}, {3.5f, 6, 2.7f},
             scene.tiles({0.44f, 0.30f, 0.18f}, {0.40f, 0.27f, 0.16f}, 0.5f), wall,
             scene.matte({0.78f, 0.77f, 0.74f}));
  scene.block(scene.matte({0.50f, 0.44f, 0.36f}), {0, 2.6f, 0.01f}, {3.2f, 2.4f, 0.02f});
  add_sofa(scene, cloth, {0.2f, 4.6f, 0}, 0);
  add_sofa(scene, cloth, {2.5f, 2.2f, 0}, -90);
  scene.block(wood, {0.2f, 2.7f, 0.38f}, {1.3f, 0.7f, 0.06f});
  for (const float x : {-0.35f, 0.75f}) scene.block(wood, {x, 2.7f, 0.18f}, {0.06f, 0.6f, 0.36f});
  scene.block(wood, {-3.1f, 2.2f, 0.3f}, {0.5f, 1.8f, 0.6f});
  scene.block(set, {-3.2f, 2.2f, 1.1f}, {0.08f, 1.5f, 0.85f});
  scene.block(picture, {0.2f, 5.96f, 1.7f}, {1.5f, 0.05f, 0.8f});
  scene.ball(plant, {-2.9f, 5.2f, 1.0f}, 0.5f);
  scene.block(wood, {-2.9f, 5.2f, 0.25f}, {0.4f, 0.4f, 0.5f});
  scene.block(scene.shining({620, 650, 680}), {3.47f, 4.3f, 1.6f}, {0.05f, 1.6f, 1.2f});
  scene.lamp({2.9f, 4.3f, 1.7f}, {330, 350, 370});
  scene.lamp({-0.5f, 1, 2.5f}, {170, 150, 120});
  scene.ambient({130, 125, 118}, {85, 75, 62});
  return scene.finish("after-living-room", {}, {{-1.6f, -2.1f, 1.5f}, {0.6f, 4, 0.9f}},
                      {{0.6f, -1.6f, 1.5f}, {-0.6f, 4.2f, 0.9f}});
}

}  // namespace plenolab
