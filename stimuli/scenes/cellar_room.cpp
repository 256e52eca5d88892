#include "stimuli/scenes/cellar_room.h"

#include <array>
#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/props.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {
namespace {

// The room: x to the right, y away from the cameras at y = 0, floor at z = 0.
constexpr float kLeft = -2.3f, kRight = 2.5f, kBack = -2.4f, kFar = 7.4f, kCeiling = 2.45f;
constexpr float kBoardThickness = 0.028f;
constexpr WallOpening kWindow{1.75f, 2.95f, 1.0f, 1.95f};    // in the far wall, from its left end
constexpr WallOpening kHatch{6.2f, 6.95f, 1.7f, 2.15f};      // in the left wall, from its near end
constexpr float kPostSide = 0.16f, kPostX = 0.74f;           // near post: left edge at 0.66 m
constexpr float kSunElevationDeg = 24, kSunAzimuthDeg = 14;  // azimuth from +y to the right

struct Materials {
  int wood, beam, stone, floor, mortar, iron, glass, clay, grass, leaves, flame;
};

Materials make_materials(SceneAssembler& scene) {
  const auto pits = bumpy({.height_m = 0.004f});
  Materials m{};
  m.wood = scene.material(
      diffuse(wood({.light = {0.50f, 0.36f, 0.22f}, .dark = {0.20f, 0.125f, 0.07f}, .seed = 3})));
  m.beam = scene.material(diffuse(wood({.light = {0.46f, 0.32f, 0.19f},
                                        .dark = {0.15f, 0.09f, 0.05f},
                                        .ring_m = 0.016f,
                                        .weathering = 0.45f,
                                        .seed = 9}),
                                  bumpy({.height_m = 0.003f, .frequency_per_m = {60, 60, 5}})));
  m.stone =
      scene.material(diffuse(stone({.light = {0.60f, 0.53f, 0.43f}, .dark = {0.30f, 0.27f, 0.235f}}), pits));
  m.floor = scene.material(
      glossy(stone({.light = {0.42f, 0.385f, 0.33f}, .dark = {0.2f, 0.185f, 0.17f}, .seed = 12}),
             constant(0.35f), 1.45f, pits));
  m.mortar =
      scene.material(diffuse(mottled({0.42f, 0.38f, 0.32f}, {0.24f, 0.21f, 0.18f}, 0.25f, 0, 21), pits));
  m.iron = scene.material(diffuse(mottled({0.10f, 0.085f, 0.075f}, {0.22f, 0.11f, 0.05f}, 0.05f, -0.2f, 33)));
  m.glass = scene.material(glossy(plain({0.03f, 0.055f, 0.03f}), constant(0.12f), 1.5f));
  m.clay = scene.material(
      glossy(mottled({0.42f, 0.2f, 0.1f}, {0.25f, 0.12f, 0.07f}, 0.08f, 0, 41), constant(0.3f), 1.5f));
  m.grass = scene.material(diffuse(mottled({0.06f, 0.11f, 0.025f}, {0.13f, 0.15f, 0.05f}, 0.6f, 0, 51)));
  m.leaves = scene.material(diffuse(mottled({0.07f, 0.14f, 0.03f}, {0.2f, 0.3f, 0.07f}, 0.35f, 0, 61)));
  m.flame = scene.material(lamp({9000, 6100, 3000}));
  return m;
}

void add_walls(SceneAssembler& scene, const Materials& m) {
  const float length = kFar - kBack, width = kRight - kLeft;
  add_stone_wall(scene, m.stone, m.mortar, pose({kLeft, kBack, 0}, 90), length, kCeiling, {.seed = 11},
                 kHatch);
  add_stone_wall(scene, m.stone, m.mortar, pose({kRight, kFar, 0}, -90), length, kCeiling, {.seed = 12});
  add_stone_wall(scene, m.stone, m.mortar, pose({kLeft, kFar, 0}), width, kCeiling, {.seed = 13}, kWindow);
  // The wall behind the cameras with its door ajar.
  const auto back = [&](float x0, float x1, float z0, float z1) {
    scene.add(m.mortar, placed(upright_rectangle(x0, x1, z0, z1, 0), pose({kLeft, kBack, 0})));
  };
  back(0, 1.2f, 0, kCeiling);
  back(1.9f, width, 0, kCeiling);
  back(1.2f, 1.9f, 1.9f, kCeiling);
}

void add_floor(SceneAssembler& scene, const Materials& m) {
  const MasonryLook flags{.course_min = 0.42f,
                          .course_max = 0.66f,
                          .stone_min = 0.45f,
                          .stone_max = 0.95f,
                          .depth = 0.1f,
                          .joint = 0.016f,
                          .rounding = 0.018f,
                          .roughness = 0.007f,
                          .proud = 0.006f,
                          .cuts = 6,
                          .seed = 5};
  const Eigen::Affine3f lay = Eigen::Translation3f(kLeft, kBack, 0) *
                              Eigen::AngleAxisf(-static_cast<float>(EIGEN_PI) / 2, Vec3::UnitX()) *
                              Eigen::Affine3f::Identity();
  add_stone_wall(scene, m.floor, m.mortar, lay, kRight - kLeft, kFar - kBack, flags);
}

/// Boards along the room, some tight, others with a slit in millimetres before the next. Thin slits show the
/// sky only: they are deeper than wide as seen from the sun. The three wide ones let the sun through, and
/// some cameras see it.
constexpr std::array<int, 24> kSlitsMm{0, 9,  0, 0, 55, 0, 7, 0,  0, 11, 0, 0,
                                       0, 95, 0, 0, 9,  0, 0, 60, 0, 8,  0, 0};

/// Slits become portals of the sky.
void add_ceiling(SceneAssembler& scene, Scene& description, const Materials& m) {
  const float length = kFar - kBack + 0.2f, middle_y = (kFar + kBack) / 2;
  const float pitch = (kRight - kLeft) / static_cast<float>(kSlitsMm.size());
  for (std::size_t i = 0; i < kSlitsMm.size(); ++i) {
    const float slit = static_cast<float>(kSlitsMm[i]) / 1000, x = kLeft + pitch * static_cast<float>(i);
    const float width = kSlitsMm[i] == 0 ? pitch + 0.001f : pitch - slit;
    const Mesh board =
        numbered(bevelled_box({width, length, kBoardThickness}, 0.003f), 29 * static_cast<int>(i));
    scene.add(m.wood, placed(board, Vec3(x + width / 2, middle_y, kCeiling + kBoardThickness / 2)));
    if (slit > 0) {
      description.portals.push_back(
          {{x + width, kBack, kCeiling + kBoardThickness}, {slit, 0, 0}, {0, kFar - kBack, 0}});
    }
  }
  for (int i = 0; i < 9; ++i) {
    const float y = kBack + 0.5f + 1.12f * static_cast<float>(i);
    const Mesh joist = numbered(bevelled_box({kRight - kLeft + 0.2f, 0.1f, 0.15f}, 0.008f), 17 * i + 5);
    scene.add(m.beam, placed(joist, Vec3((kLeft + kRight) / 2, y, kCeiling - 0.075f)));
  }
}

/// Girder below the joists on posts with braces. The near post stands where some cameras no longer see it.
void add_timber(SceneAssembler& scene, const Materials& m) {
  const float girder_z = kCeiling - 0.15f - 0.1f;
  scene.add(m.beam, placed(numbered(bevelled_box({0.18f, kFar - kBack + 0.2f, 0.2f}, 0.012f), 77),
                           Vec3(kPostX, (kFar + kBack) / 2, girder_z)));
  int number = 90;
  for (const float y : {0.9f, 4.3f}) {
    const float height = girder_z - 0.1f;
    scene.add(m.beam, placed(numbered(bevelled_box({kPostSide, kPostSide, height}, 0.012f), number += 7),
                             Vec3(kPostX, y, height / 2)));
    for (const float side : {-1.f, 1.f}) {
      if (y < 1 && side < 0) continue;  // no brace in front of the cameras
      const Eigen::Affine3f brace = Eigen::Translation3f(kPostX, y + side * 0.36f, height - 0.34f) *
                                    Eigen::AngleAxisf(-side * 0.76f, Vec3::UnitX()) *
                                    Eigen::Affine3f::Identity();
      scene.add(m.beam, placed(numbered(bevelled_box({0.1f, 0.1f, 1.0f}, 0.008f), number += 7), brace));
    }
  }
}

void add_window(SceneAssembler& scene, Scene& description, const Materials& m) {
  const auto [x0, x1, z0, z1] = kWindow;
  const float width = x1 - x0, height = z1 - z0, y = kFar + 0.22f;
  const Vec3 centre(kLeft + (x0 + x1) / 2, y, (z0 + z1) / 2);
  const auto bar = [&](const Vec3& size, const Vec3& offset, int number) {
    scene.add(m.wood, placed(numbered(bevelled_box(size, 0.006f), number), Vec3(centre + offset)));
  };
  for (const float side : {-1.f, 1.f}) {
    bar({0.06f, 0.06f, height}, {side * (width - 0.06f) / 2, 0, 0}, 201);
    bar({width, 0.06f, 0.06f}, {0, 0, side * (height - 0.06f) / 2}, 202);
    bar({0.028f, 0.03f, height}, {side * width / 6, 0, 0}, 203);
  }
  bar({width, 0.03f, 0.028f}, {0, 0, 0.02f}, 204);
  // Lintel and sill.
  scene.add(m.beam, placed(numbered(bevelled_box({width + 0.5f, 0.16f, 0.16f}, 0.012f), 205),
                           Vec3(centre.x(), kFar + 0.05f, kWindow.z1 + 0.08f)));
  scene.add(m.floor, placed(numbered(rough_stone({width + 0.2f, 0.34f, 0.09f}, 0.015f, 0.004f, 8, 3), 206),
                            Vec3(centre.x(), kFar + 0.1f, kWindow.z0 - 0.03f)));
  description.portals.push_back({{kLeft + x0, kFar + 0.33f, z0}, {width, 0, 0}, {0, 0, height}});
  description.portals.push_back({{kLeft - 0.33f, kBack + kHatch.x0, kHatch.z0},
                                 {0, kHatch.x1 - kHatch.x0, 0},
                                 {0, 0, kHatch.z1 - kHatch.z0}});
  description.portals.push_back({{kLeft + 1.2f, kBack - 0.02f, 0}, {0.7f, 0, 0}, {0, 0, 1.9f}});
}

/// What the window shows: a bank of grass with bushes against the sky.
void add_outside(SceneAssembler& scene, const Materials& m) {
  const auto bank = [](float u, float v) {
    const float x = -14 + 28 * u, y = kFar + 0.5f + 30 * v;
    return Vec3(x, y, 0.75f + 1.1f * v + 0.05f * fractal_noise({x, y, 0}, 4, 3));
  };
  scene.add(m.grass, surface(120, 100, bank));
  RandomStream random(3, 0x62757368, 0);
  for (int i = 0; i < 26; ++i) {
    const float x = -9 + 18 * random.next_float(), y = kFar + 12 + 14 * random.next_float();
    const float size = 0.5f + 0.8f * random.next_float();
    Mesh bush = ellipsoid({size, size, size * 0.9f}, 60);
    for (Vec3& p : bush.positions_m) {
      p *= 1 + 0.35f * fractal_noise(p * (3.f / size) + Vec3(static_cast<float>(i) * 5, 0, 0), 4, 9);
    }
    smooth_normals(bush);
    scene.add(m.leaves, placed(bush, Vec3(x, y, 1.2f)));
  }
}

/// Oil lamps: one hangs from the girder in the middle of the room, one behind the cameras fills the shadows.
void add_lamps(SceneAssembler& scene, const Materials& m) {
  for (const auto& [place, radius] :
       {std::pair{Vec3(0.42f, 3.35f, 1.8f), 0.085f}, std::pair{Vec3(-1.0f, -1.3f, 1.75f), 0.2f}}) {
    scene.add(m.flame, placed(ellipsoid({radius, radius, 1.25f * radius}, 20), place));
    const std::array<std::array<float, 2>, 5> hood{{{0.4f * radius, 2.6f * radius},
                                                    {0.5f * radius, 1.9f * radius},
                                                    {1.5f * radius, 1.45f * radius},
                                                    {1.5f * radius, 1.35f * radius},
                                                    {0.1f * radius, 1.5f * radius}}};
    scene.add(m.iron, placed(lathe(hood, 20), place));
    const std::array<std::array<float, 2>, 5> foot{{{0.f, -2.1f * radius},
                                                    {1.2f * radius, -2.1f * radius},
                                                    {1.2f * radius, -1.4f * radius},
                                                    {0.8f * radius, -1.3f * radius},
                                                    {0.f, -1.3f * radius}}};
    scene.add(m.iron, placed(lathe(foot, 20), place));
    for (const float turn : {0.4f, 1.97f, 3.54f, 5.11f}) {
      const Vec3 bar = place + 1.25f * radius * Vec3(std::cos(turn), std::sin(turn), 0);
      scene.add(m.iron,
                rod(bar - Vec3(0, 0, 1.4f * radius), bar + Vec3(0, 0, 1.4f * radius), 0.003f, 0.003f, 5));
    }
    scene.add(m.iron, rod(place + Vec3(0, 0, 2.5f * radius), Vec3(place.x(), place.y(), kCeiling), 0.006f,
                          0.006f, 6));
  }
}

void add_barrels(SceneAssembler& scene, const Materials& m) {
  add_barrel(scene, m.wood, m.iron, pose({2.0f, 3.4f, 0}, 20), 0.92f, 10);
  add_barrel(scene, m.wood, m.iron, pose({1.95f, 4.35f, 0}, 75), 0.92f, 60);
  add_barrel(scene, m.wood, m.iron, pose({1.35f, 5.2f, 0}, 130), 0.78f, 110);
  const Eigen::Affine3f lying =
      pose({1.75f, 6.0f, 0.3f}, -25) * Eigen::AngleAxisf(static_cast<float>(EIGEN_PI) / 2, Vec3::UnitY());
  add_barrel(scene, m.wood, m.iron, lying, 0.85f, 160);
}

void add_crates(SceneAssembler& scene, const Materials& m) {
  add_crate(scene, m.wood, pose({-1.55f, 3.1f, 0}, 12), {0.62f, 0.46f, 0.38f}, 1);
  add_crate(scene, m.wood, pose({-1.62f, 3.16f, 0.385f}, -9), {0.56f, 0.42f, 0.32f}, 40);
  add_crate(scene, m.wood, pose({-0.98f, 3.75f, 0}, 34), {0.6f, 0.42f, 0.34f}, 80);
  RandomStream random(5, 0x626f7474, 0);
  for (int i = 0; i < 9; ++i) {
    const Vec3 place(-1.0f + 0.12f * static_cast<float>(i % 3 - 1),
                     3.75f + 0.1f * static_cast<float>(i / 3 - 1), 0.03f);
    scene.add(m.glass, placed(bottle(0.36f + 0.06f * random.next_float()), place));
  }
  scene.add(m.clay, placed(jar(0.36f), Vec3(-1.6f, 3.1f, 0.42f)));
}

void add_shelf(SceneAssembler& scene, const Materials& m) {
  const float y0 = 5.0f, y1 = 7.0f, depth = 0.34f, x = kLeft + depth / 2 + 0.02f;
  for (const float y : {y0, (y0 + y1) / 2, y1}) {
    scene.add(m.beam, placed(numbered(bevelled_box({depth, 0.05f, 1.9f}, 0.005f), 31), Vec3(x, y, 0.95f)));
  }
  RandomStream random(6, 0x7368656c, 0);
  for (int level = 0; level < 4; ++level) {
    const float z = 0.25f + 0.5f * static_cast<float>(level);
    scene.add(m.wood, placed(numbered(bevelled_box({depth, y1 - y0, 0.03f}, 0.004f), 50 + level),
                             Vec3(x, (y0 + y1) / 2, z)));
    for (float y = y0 + 0.12f; y < y1 - 0.12f; y += 0.13f + 0.1f * random.next_float()) {
      if (random.next_float() < 0.18f) continue;
      const Vec3 place(x + 0.06f * (random.next_float() - 0.3f), y, z + 0.015f);
      const float choice = random.next_float();
      if (choice < 0.55f) {
        scene.add(m.glass, placed(bottle(0.26f + 0.1f * random.next_float()), place));
      } else {
        scene.add(choice < 0.8f ? m.clay : m.stone,
                  numbered(placed(jar(0.16f + 0.12f * random.next_float()), place), level));
      }
    }
  }
}

Vec3 sun_direction() {
  constexpr float kDegree = static_cast<float>(EIGEN_PI) / 180;
  const float elevation = kSunElevationDeg * kDegree, azimuth = kSunAzimuthDeg * kDegree;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

}  // namespace

Scene cellar_room() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  add_walls(scene, m);
  add_floor(scene, m);
  add_ceiling(scene, result, m);
  add_timber(scene, m);
  add_window(scene, result, m);
  add_outside(scene, m);
  add_lamps(scene, m);
  add_barrels(scene, m);
  add_crates(scene, m);
  add_shelf(scene, m);
  scene.add(m.wood, ladder({-2.0f, 2.55f, 0}, {-2.2f, 2.75f, 2.3f}, Vec3(0.0f, 1.f, 0), 0.38f, 61));
  scene.finish(result);
  result.sun = Sun{.direction = sun_direction(), .illuminance_lx = {108000, 97000, 80000}};
  result.sky.kind = Sky::Kind::kDaylight;
  result.sky.ground_cd_m2 = {900, 1000, 600};
  result.sky.turbidity = 3;
  result.camera = camera_along_y({0, 0, 1.45f}, 80);
  result.quick = quick_views(0.1, 0.08, 16);
  result.paper = paper_views(0.05, 5);
  result.max_bounces = 2;
  result.caustics = false;
  return result;
}

}  // namespace plenolab
