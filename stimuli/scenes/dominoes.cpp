// Dominoes: a chain of dominoes winds over a table in a dim room and has just begun to fall. The low sun
// shines through a small window high in the wall, outside the picture, onto a poster; the room has no other
// light than what this patch and the window's bit of sky send about. Light of the second bounce makes renders
// at few paths noisy everywhere but on the poster: its sunlit paper is lit directly, is seen by every camera
// and is the brightest thing in every view. The extremes of the views are stable although the views are
// noisy.
//
// Light: sun of 45 000 lx (28 000 lx on the wall), sunlit paper 6 000–7 000 cd/m², wall and table 3–60
// cd/m², shadows below the table 0.5 cd/m².

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/props.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

constexpr float kPi = static_cast<float>(EIGEN_PI);
// The room: x to the right, y away from the cameras at y = 0, floor at z = 0.
constexpr float kLeft = -2.3f, kRight = 2.4f, kBack = -1.9f, kFar = 3.6f, kCeiling = 2.75f;
constexpr float kTable = 0.74f;
constexpr WallOpening kWindow{2.25f, 2.95f, 1.98f, 2.53f};  // in the right wall, from its far end
constexpr WallOpening kPoster{-0.98f, -0.12f, 0.93f, 1.9f};
const Vec3 kTile{0.034f, 0.01f, 0.068f};  // a domino: across, thick, tall

struct Materials {
  int plaster, panel, ceiling, floor, table, rug, ivory, ebony, red, pip_dark, pip_light, poster, frame,
      brass, clay, leaf;
  std::array<int, 5> books;
};

/// A poster in the manner of the twenties: discs and beams on cream paper.
Rgb poster_colour(const SurfacePoint& point) {
  const float width = kPoster.x1 - kPoster.x0, height = kPoster.z1 - kPoster.z0;
  const float u = (point.position_m.x() - kPoster.x0) / width - 0.5f;
  const float v = (point.position_m.z() - kPoster.z0) / width - 0.5f * height / width;
  const auto disc = [&](float x, float y) { return std::hypot(u - x, v - y); };
  const float fibre = 0.97f + 0.03f * gradient_noise(point.position_m * 120, 4);
  if (std::abs(u) > 0.44f || std::abs(v) > 0.5f * height / width - 0.06f)
    return Rgb{0.83f, 0.81f, 0.74f} * fibre;
  if (disc(0.12f, 0.14f) < 0.17f) return Rgb{0.70f, 0.13f, 0.07f} * fibre;
  if (disc(-0.18f, -0.12f) < 0.23f && disc(-0.18f, -0.12f) > 0.17f) return Rgb{0.05f, 0.05f, 0.055f} * fibre;
  if (std::abs(u + 0.8f * v + 0.02f) < 0.035f) return Rgb{0.05f, 0.05f, 0.055f} * fibre;
  if (std::abs(u - 0.9f * v + 0.13f) < 0.06f && v < 0.1f) return Rgb{0.78f, 0.56f, 0.1f} * fibre;
  if (v < -0.38f && v > -0.46f && std::abs(u) < 0.36f && std::fmod(u + 0.5f, 0.09f) < 0.06f) {
    return Rgb{0.08f, 0.16f, 0.3f} * fibre;
  }
  return Rgb{0.8f, 0.765f, 0.66f} * fibre;
}

Rgb rug_colour(const SurfacePoint& point) {
  const Vec3& p = point.position_m;
  const float band = std::fmod(std::abs(p.y() + 10), 0.4f),
              tooth = std::abs(std::fmod(p.x() + 10, 0.2f) - 0.1f);
  const Rgb ground = band < 0.06f + tooth ? Rgb{0.34f, 0.06f, 0.045f} : Rgb{0.07f, 0.08f, 0.16f};
  return mix(ground, {0.5f, 0.38f, 0.2f}, band > 0.34f ? 0.8f : 0.f) *
         (0.8f + 0.2f * gradient_noise(p * 150, 9));
}

Materials make_materials(SceneAssembler& scene) {
  Materials m{};
  const auto grainy = bumpy({.height_m = 0.0008f, .frequency_per_m = {45, 45, 45}, .octaves = 3});
  m.plaster =
      scene.material(diffuse(mottled({0.58f, 0.53f, 0.43f}, {0.49f, 0.44f, 0.35f}, 0.7f, 0, 11), grainy));
  m.ceiling = scene.material(diffuse(plain({0.75f, 0.74f, 0.7f})));
  m.panel = scene.material(diffuse(wood(
      {.light = {0.20f, 0.25f, 0.22f}, .dark = {0.14f, 0.18f, 0.16f}, .weathering = 0.05f, .seed = 12})));
  m.floor = scene.material(diffuse(
      wood({.light = {0.40f, 0.27f, 0.15f}, .dark = {0.2f, 0.12f, 0.06f}, .weathering = 0.1f, .seed = 13})));
  m.table = scene.material(glossy(wood({.light = {0.42f, 0.22f, 0.10f},
                                        .dark = {0.19f, 0.085f, 0.035f},
                                        .ring_m = 0.02f,
                                        .weathering = 0.02f,
                                        .seed = 14}),
                                  constant(0.22f), 1.5f));
  m.rug = scene.material(diffuse(rug_colour));
  m.ivory = scene.material(glossy(plain({0.74f, 0.69f, 0.56f}), constant(0.16f), 1.5f));
  m.ebony = scene.material(glossy(plain({0.035f, 0.03f, 0.03f}), constant(0.12f), 1.5f));
  m.red = scene.material(glossy(plain({0.5f, 0.04f, 0.03f}), constant(0.14f), 1.5f));
  m.pip_dark = scene.material(diffuse(plain({0.03f, 0.03f, 0.03f})));
  m.pip_light = scene.material(diffuse(plain({0.78f, 0.76f, 0.7f})));
  m.poster = scene.material(diffuse(poster_colour));
  m.frame = scene.material(diffuse(plain({0.05f, 0.04f, 0.035f})));
  m.brass = scene.material(
      {.kind = Material::Kind::kMetal, .albedo = plain({0.83f, 0.63f, 0.3f}), .roughness = constant(0.25f)});
  m.clay = scene.material(
      glossy(mottled({0.15f, 0.26f, 0.33f}, {0.09f, 0.17f, 0.24f}, 0.08f, 0, 15), constant(0.18f), 1.5f));
  m.leaf = scene.material(diffuse(mottled({0.09f, 0.2f, 0.06f}, {0.16f, 0.28f, 0.08f}, 0.1f, 0, 16)));
  m.books = {scene.material(diffuse(plain({0.42f, 0.09f, 0.07f}))),
             scene.material(diffuse(plain({0.08f, 0.17f, 0.3f}))),
             scene.material(diffuse(plain({0.12f, 0.26f, 0.16f}))),
             scene.material(diffuse(plain({0.56f, 0.44f, 0.2f}))),
             scene.material(diffuse(plain({0.62f, 0.57f, 0.48f})))};
  return m;
}

void add_box(SceneAssembler& scene, int material, const Vec3& size, const Vec3& centre, int number = 0) {
  const float bevel = std::min(0.004f, 0.2f * size.minCoeff());
  scene.add(material, placed(numbered(bevelled_box(size, bevel), number), centre));
}

void add_room(SceneAssembler& scene, const Materials& m) {
  const float depth = kFar - kBack, width = kRight - kLeft, middle_x = (kLeft + kRight) / 2,
              middle_y = (kFar + kBack) / 2;
  constexpr float kThick = 0.14f;
  const auto wall = [&](const Vec3& size, const Vec3& centre) { add_box(scene, m.plaster, size, centre); };
  wall({width + 2 * kThick, kThick, kCeiling}, {middle_x, kFar + kThick / 2, kCeiling / 2});
  wall({width + 2 * kThick, kThick, kCeiling}, {middle_x, kBack - kThick / 2, kCeiling / 2});
  wall({kThick, depth, kCeiling}, {kLeft - kThick / 2, middle_y, kCeiling / 2});
  const float x = kRight + kThick / 2, y0 = kFar - kWindow.x1, y1 = kFar - kWindow.x0;
  wall({kThick, depth, kWindow.z0}, {x, middle_y, kWindow.z0 / 2});
  wall({kThick, depth, kCeiling - kWindow.z1}, {x, middle_y, (kCeiling + kWindow.z1) / 2});
  const float sill = (kWindow.z0 + kWindow.z1) / 2, tall = kWindow.z1 - kWindow.z0;
  wall({kThick, kFar - y1, tall}, {x, (kFar + y1) / 2, sill});
  wall({kThick, y0 - kBack, tall}, {x, (kBack + y0) / 2, sill});
  add_box(scene, m.ceiling, {width + 2 * kThick, depth + 2 * kThick, kThick},
          {middle_x, middle_y, kCeiling + kThick / 2});
  int number = 0;
  for (float at = kLeft + 0.06f; at < kRight; at += 0.12f) {
    add_box(scene, m.floor, {0.118f, depth, 0.03f}, {at, middle_y, -0.015f}, number += 7);
  }
  for (float at = kLeft + 0.07f; at < kRight; at += 0.14f) {
    add_box(scene, m.panel, {0.136f, 0.02f, 0.82f}, {at, kFar - 0.01f, 0.41f}, number += 5);
  }
  add_box(scene, m.panel, {width, 0.05f, 0.05f}, {middle_x, kFar - 0.025f, 0.845f}, 3);
  scene.add(m.rug, placed(bevelled_box({3.2f, 2.6f, 0.012f}, 0.003f), Vec3(0, 1.5f, 0.006f)));
}

void add_poster(SceneAssembler& scene, const Materials& m) {
  const auto [x0, x1, z0, z1] = kPoster;
  scene.add(m.poster, upright_rectangle(x0, x1, z0, z1, kFar - 0.012f));
  for (const float x : {x0, x1})
    add_box(scene, m.frame, {0.022f, 0.03f, z1 - z0 + 0.02f}, {x, kFar - 0.015f, (z0 + z1) / 2});
  for (const float z : {z0, z1})
    add_box(scene, m.frame, {x1 - x0 + 0.02f, 0.03f, 0.022f}, {(x0 + x1) / 2, kFar - 0.015f, z});
}

void add_table(SceneAssembler& scene, const Materials& m) {
  int number = 0;
  for (float y = 0.55f; y < 2.45f; y += 0.16f) {
    add_box(scene, m.table, {2.3f, 0.1595f, 0.035f}, {0, y + 0.08f, kTable - 0.0175f}, number += 9);
  }
  for (const float x : {-1.05f, 1.05f}) {
    for (const float y : {0.7f, 2.35f})
      scene.add(m.table, rod({x, y, 0}, {x, y, kTable - 0.03f}, 0.03f, 0.045f, 20));
  }
}

/// Places of the pips of a value on a half of a domino, in quarters of its width; the first `value` of a row.
constexpr std::array<std::array<std::array<float, 2>, 6>, 7> kPips{
    {{},
     {{{0, 0}}},
     {{{-1, -1}, {1, 1}}},
     {{{-1, -1}, {1, 1}, {0, 0}}},
     {{{-1, -1}, {1, 1}, {-1, 1}, {1, -1}}},
     {{{-1, -1}, {1, 1}, {-1, 1}, {1, -1}, {0, 0}}},
     {{{-1, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, 0}, {1, 0}}}}};

/// One domino that stands at the origin, its faces along ±y.
void add_domino(SceneAssembler& scene, int tile, int pip, const Eigen::Affine3f& at, RandomStream& random) {
  const Vec3 middle(0, 0, kTile.z() / 2);
  scene.add(tile, placed(placed(bevelled_box(kTile, 0.0018f), middle), at));
  const Mesh dot = ellipsoid({0.0031f, 0.0003f, 0.0031f}, 12);
  const float face = kTile.y() / 2;
  scene.add(pip, placed(placed(bevelled_box({0.026f, 2 * face + 0.0003f, 0.0011f}, 0.0001f), middle), at));
  for (const float half : {0.25f, 0.75f}) {
    const auto value = static_cast<std::size_t>(7 * random.next_float());
    for (std::size_t i = 0; i < value; ++i) {
      const auto [x, z] = kPips[value][i];
      const float step = kTile.x() / 4;
      scene.add(pip, placed(placed(dot, Vec3(x * step, -face, half * kTile.z() + z * step)), at));
    }
  }
}

/// Where the chain runs, t in [0, 1] from its first domino, which lies at the far end.
Vec3 chain(float t) {
  const float back = 1 - t;
  return {(0.66f - 0.1f * back) * std::cos(3 * kPi * t + 0.35f) + 0.05f, 0.98f + 1.2f * back, kTable};
}

/// The chain: the first dominoes have fallen onto the next, a few are just falling.
void add_chain(SceneAssembler& scene, const Materials& m) {
  constexpr float kPitch = 0.031f;
  constexpr int kSteps = 4000, kFallen = 34, kFalling = 5;
  RandomStream random(43, 0x646f6d69, 0);
  float along = 0;
  int count = 0;
  for (int i = 0; i + 1 < kSteps; ++i) {
    const Vec3 here = chain(static_cast<float>(i) / kSteps), next = chain(static_cast<float>(i + 1) / kSteps);
    along += (next - here).norm();
    if (along < kPitch * static_cast<float>(count)) continue;
    const Vec3 way = (next - here).normalized();
    const float yaw = std::atan2(way.y(), way.x()) * 180 / kPi - 90 + 5 * (random.next_float() - 0.5f);
    const float upright = smooth_step(kFallen, kFallen + kFalling, static_cast<float>(count));
    const float lean = 1.16f * (1 - upright);
    Eigen::Affine3f at = pose(here, yaw) * Eigen::Translation3f(0, kTile.y() / 2, 0) *
                         Eigen::AngleAxisf(-lean, Vec3::UnitX()) * Eigen::Translation3f(0, -kTile.y() / 2, 0);
    const int kind = count % 9;
    const int tile = kind == 4 ? m.red : (kind == 8 ? m.ebony : m.ivory);
    add_domino(scene, tile, tile == m.ivory ? m.pip_dark : m.pip_light, at, random);
    ++count;
  }
}

/// A shelf with books and a jar on the back wall, right of the poster.
void add_shelf(SceneAssembler& scene, const Materials& m) {
  RandomStream random(47, 0x626f6f6b, 0);
  constexpr float kX0 = 0.35f, kX1 = 1.75f, kDepth = 0.24f;
  int number = 0;
  for (const float z : {1.1f, 1.46f}) {
    add_box(scene, m.table, {kX1 - kX0, kDepth, 0.025f}, {(kX0 + kX1) / 2, kFar - kDepth / 2, z},
            number += 3);
    for (const float x : {kX0 + 0.12f, kX1 - 0.12f})
      add_box(scene, m.brass, {0.02f, 0.18f, 0.1f}, {x, kFar - 0.1f, z - 0.06f});
    float x = kX0 + 0.04f;
    while (x < kX1 - (z > 1.2f ? 0.5f : 0.08f)) {
      const float thick = 0.02f + 0.03f * random.next_float(), tall = 0.19f + 0.09f * random.next_float();
      const auto book = static_cast<std::size_t>(5 * random.next_float());
      if (random.next_float() > 0.12f) {
        add_box(scene, m.books[book], {thick, 0.17f, tall},
                {x + thick / 2, kFar - 0.11f, z + 0.0125f + tall / 2});
      }
      x += thick + 0.002f;
    }
  }
  scene.add(m.clay, placed(jar(0.27f), Vec3(1.5f, kFar - 0.12f, 1.4725f)));
}

/// A pot with a plant on the table and the box the dominoes came from.
void add_things(SceneAssembler& scene, const Materials& m) {
  RandomStream random(53, 0x706c616e, 0);
  const Vec3 pot(-0.86f, 2.15f, kTable);
  scene.add(m.clay, placed(jar(0.2f), pot));
  for (int i = 0; i < 46; ++i) {
    const float turn = 2.4f * static_cast<float>(i), reach = 0.05f + 0.17f * random.next_float();
    const Vec3 tip =
        pot + Vec3(reach * std::cos(turn), reach * std::sin(turn), 0.22f + 0.24f * random.next_float());
    const Vec3 root = pot + Vec3(0, 0, 0.18f);
    scene.add(m.leaf, rod(root, tip, 0.0025f, 0.0015f, 4));
    Eigen::Affine3f at = pose(tip, turn * 180 / kPi - 90);
    at.linear() *= 0.07f + 0.05f * random.next_float();
    scene.add(m.leaf, placed(leaf(0.5f, 0.1f, 0.35f), at));
  }
  const Eigen::Affine3f box = pose({0.88f, 1.75f, kTable}, 24);
  add_crate(scene, m.floor, box, {0.24f, 0.17f, 0.09f}, 70);
}

}  // namespace

Scene build_dominoes() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  add_room(scene, m);
  add_poster(scene, m);
  add_table(scene, m);
  add_chain(scene, m);
  add_shelf(scene, m);
  add_things(scene, m);
  scene.finish(result);
  result.id = "dominoes";
  result.title = "Dominoes";
  result.description =
      "A dim room full of noisy indirect light, with one highlight free of noise: sunlight on a poster, seen "
      "by every "
      "camera, keeps the extremes of all views the same.";
  result.sun =
      Sun{.direction = Vec3(0.72f, -0.62f, 0.2f).normalized(), .illuminance_lx = {50000, 45000, 34000}};
  result.sky.kind = Sky::Kind::kDaylight;
  result.sky.turbidity = 3;
  result.sky.ground_cd_m2 = {900, 900, 700};
  result.caustics = false;
  result.portals.push_back({{kRight + 0.15f, kFar - kWindow.x1, kWindow.z0},
                            {0, kWindow.x1 - kWindow.x0, 0},
                            {0, 0, kWindow.z1 - kWindow.z0}});
  result.camera = camera_along_y({0, 0, 1.28f}, 58, -9);
  result.quick = quick_views(0.06, 0.06, 32);
  result.paper = paper_views(0.03);
  result.max_bounces = 3;
  return result;
}

}  // namespace plenolab
