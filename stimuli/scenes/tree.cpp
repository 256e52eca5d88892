// Tree: an old tree on a meadow before a smooth bright sky, a split-rail fence, a swing, and hills far away.
// Leaves and twigs of one or two pixels: fine structure is lost in synthesis, and holes in the foliage leave
// background unseen that is restored without a fault, since the sky behind is nearly uniform.
//
// Light: afternoon sun of 100 000 lx at 36° from the left behind the cameras, sky from 4 500 cd/m² overhead
// to 9 000 cd/m² at the horizon; leaves 300–6 000 cd/m², shade under the crown about 100 cd/m².

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"
#include "stimuli/scenes/modelling/vegetation.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

const Vec3 kTreeFoot{0.7f, 11.5f, 0};

struct Materials {
  int meadow, grass, bark, leaves, wood, rope, white, yellow, red, stone;
  std::array<int, 3> ridges;
};

/// A hill whose crest lies behind the tree.
float terrain(float x, float y) {
  const float crest = 0.9f * std::exp(-(y - 15) * (y - 15) / 60 - (x - 2) * (x - 2) / 260);
  const float valley = -0.05f * std::max(0.f, y - 20);
  return crest + valley + 0.12f * fractal_noise({x * 0.22f, y * 0.22f, 0}, 4, 3);
}

Rgb blade_colour(const SurfacePoint& point) {
  const PartPoint part = part_of(point);
  const float tone = cell_random(part.number, 0, 0, 6), dry = cell_random(part.number, 1, 0, 6);
  const float patch = 0.5f + 0.5f * fractal_noise(point.position_m * 0.35f, 3, 44);
  const Rgb green = mix({0.085f, 0.17f, 0.025f}, {0.23f, 0.34f, 0.07f}, 0.3f * tone + 0.6f * patch);
  return mix(green, {0.42f, 0.38f, 0.16f}, dry > 0.88f ? 0.5f : 0.1f * patch) * (0.6f + 0.4f * part.v);
}

Rgb meadow_colour(const SurfacePoint& point) {
  const Vec3& p = point.position_m;
  const float patch = 0.5f + 0.6f * fractal_noise({p.x() * 0.35f, p.y() * 0.35f, 0}, 3, 44);
  const float tuft = 0.5f + 0.5f * fractal_noise({p.x() * 9, p.y() * 5, 0}, 4, 45);
  const Rgb green = mix({0.07f, 0.13f, 0.022f}, {0.22f, 0.30f, 0.07f}, 0.55f * patch + 0.5f * tuft - 0.05f);
  const float dry = smooth_step(0.55f, 0.95f, patch + 0.3f * (tuft - 0.5f));
  return mix(green, {0.34f, 0.31f, 0.13f}, 0.7f * dry);
}

Rgb leaf_colour(const SurfacePoint& point) {
  const PartPoint part = part_of(point);
  const float tone = cell_random(part.number, 0, 0, 16), age = cell_random(part.number, 1, 0, 16);
  const Rgb green = mix({0.09f, 0.18f, 0.025f}, {0.27f, 0.36f, 0.06f}, tone);
  const Rgb autumn = mix({0.46f, 0.33f, 0.06f}, {0.42f, 0.19f, 0.045f}, tone);
  const float vein = smooth_step(0.06f, 0.02f, std::abs(part.u));
  return mix(mix(green, autumn, age > 0.86f ? 0.8f : 0.f), {0.4f, 0.42f, 0.16f}, 0.4f * vein);
}

Materials make_materials(SceneAssembler& scene) {
  Materials m{};
  m.meadow = scene.material(diffuse(meadow_colour));
  m.grass = scene.material(diffuse(blade_colour));
  m.bark =
      scene.material(diffuse(bark({0.31f, 0.265f, 0.215f}, {0.09f, 0.075f, 0.06f}, 25),
                             bumpy({.height_m = 0.02f, .frequency_per_m = {14, 14, 3.5f}, .octaves = 3})));
  m.leaves = scene.material(diffuse(leaf_colour));
  m.wood = scene.material(
      diffuse(wood({.light = {0.42f, 0.36f, 0.29f}, .dark = {0.2f, 0.165f, 0.13f}, .weathering = 0.75f})));
  m.rope = scene.material(diffuse(plain({0.45f, 0.37f, 0.24f})));
  m.white = scene.material(diffuse(plain({0.8f, 0.8f, 0.76f})));
  m.yellow = scene.material(diffuse(plain({0.8f, 0.6f, 0.05f})));
  m.red = scene.material(diffuse(plain({0.62f, 0.05f, 0.03f})));
  m.stone = scene.material(diffuse(stone({.light = {0.5f, 0.48f, 0.44f}, .dark = {0.25f, 0.24f, 0.22f}})));
  m.ridges = {scene.material(diffuse(mottled({0.07f, 0.125f, 0.06f}, {0.16f, 0.20f, 0.09f}, 5, 0, 51))),
              scene.material(diffuse(mottled({0.13f, 0.19f, 0.17f}, {0.19f, 0.25f, 0.19f}, 14, 0, 52))),
              scene.material(diffuse(mottled({0.24f, 0.31f, 0.37f}, {0.29f, 0.36f, 0.40f}, 40, 0, 53)))};
  return m;
}

void add_land(SceneAssembler& scene, const Materials& m) {
  const auto near_land = [](float u, float v) {
    const float y = 1 + 59 * v * v, x = (2 * u - 1) * (8 + 1.1f * y);
    return Vec3(x, y, terrain(x, y));
  };
  scene.add(m.meadow, surface(160, 220, near_land));
  const std::array<float, 3> distances{110, 300, 800};
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const float d = distances[i], layer = static_cast<float>(i);
    const auto ridge = [d, layer](float u, float v) {
      const float x = (2 * u - 1) * 1.3f, y = 1 + 0.3f * v;  // in units of the distance
      const float swell = fractal_noise({x * 2.2f + layer * 7, y * 2.2f, 0}, 3, 60);
      const float woods = (0.005f - 0.0014f * layer) * fractal_noise({x * 45, y * 45, layer}, 3, 61);
      const float top = 0.085f + 0.02f * layer + 0.045f * swell + woods;
      return Vec3(x * d, y * d, d * (-0.06f + top * std::sin(v * 1.57f)));
    };
    scene.add(m.ridges[i], surface(360, 48, ridge));
  }
}

void add_grass(SceneAssembler& scene, const Materials& m) {
  scene.add(m.grass, grass({.near_m = 3.2f, .far_m = 15, .blades = 60000, .height_m = 0.26f}, terrain));
  RandomStream random(17, 0x666c6f77, 0);
  for (int i = 0; i < 520; ++i) {
    const float distance = 3.6f + 9 * random.next_float(), angle = 0.75f * (2 * random.next_float() - 1);
    const float x = distance * std::sin(angle), y = distance * std::cos(angle);
    const float group = fractal_noise({x * 0.5f, y * 0.5f, 0}, 2, 71);
    const int colour = group > 0.12f ? m.red : (group < -0.15f ? m.yellow : m.white);
    const float height = 0.2f + 0.16f * random.next_float(), size = 0.016f + 0.014f * random.next_float();
    const Vec3 head(x, y, terrain(x, y) + height);
    Mesh bloom = ellipsoid({size, size, 0.55f * size}, 8);
    scene.add(colour, placed(bloom, head));
    scene.add(m.grass, rod(head - Vec3(0, 0, height), head, 0.003f, 0.003f, 3));
  }
}

/// Split rails on posts, from the left foreground to the right behind the tree.
void add_fence(SceneAssembler& scene, const Materials& m) {
  RandomStream random(19, 0x66656e63, 0);
  int number = 0;
  Vec3 before = Vec3::Zero();
  for (int i = 0; i < 12; ++i) {
    const float t = static_cast<float>(i);
    const float x = -6.2f + 1.75f * t, y = 6.6f + 0.8f * t + 0.25f * random.next_float();
    const Vec3 foot(x, y, terrain(x, y) - 0.1f);
    const Vec3 lean(0.12f * (random.next_float() - 0.5f), 0.1f * (random.next_float() - 0.5f), 1.25f);
    scene.add(m.wood, numbered(rod(foot, foot + lean, 0.065f, 0.055f, 9), number += 5));
    for (const float height : {0.55f, 1.02f}) {
      if (i == 0 || (i == 4 && height > 1)) continue;  // one rail has fallen
      const auto end = [&](const Vec3& base) {
        return Vec3(base + Vec3(0, -0.04f, height + 0.1f + 0.06f * (random.next_float() - 0.5f)));
      };
      const Vec3 a = end(before), b = end(foot);
      const Vec3 overlap = 0.18f * (b - a).normalized();
      scene.add(m.wood, numbered(rod(a - overlap, b + overlap, 0.042f, 0.05f, 7), number += 5));
    }
    before = foot;
  }
}

/// A board on two ropes from a level limb.
void add_swing(SceneAssembler& scene, const Materials& m, const Vec3& foot) {
  const Vec3 root = foot + Vec3(0.1f, -0.1f, 2.1f);
  const std::array limb{root, Vec3(root + Vec3(-1.0f, -0.35f, 0.55f)),
                        Vec3(root + Vec3(-2.0f, -0.75f, 0.72f)), Vec3(root + Vec3(-2.9f, -1.0f, 0.95f)),
                        Vec3(root + Vec3(-3.5f, -1.25f, 1.35f))};
  scene.add(m.bark, tube(limb, std::array{0.15f, 0.115f, 0.09f, 0.065f, 0.03f}, 12));
  const Vec3 seat = root + Vec3(-2.2f, -0.82f, -1.45f);
  for (const float side : {-0.24f, 0.24f}) {
    const Vec3 hang(side, -0.1f * side, 0);
    scene.add(m.rope, rod(seat + hang, seat + hang + Vec3(0, 0, 2.2f), 0.018f, 0.018f, 5));
  }
  scene.add(m.wood, placed(numbered(bevelled_box({0.58f, 0.2f, 0.035f}, 0.006f), 3), seat));
}

void add_stones(SceneAssembler& scene, const Materials& m) {
  RandomStream random(23, 0x726f636b, 0);
  for (int i = 0; i < 9; ++i) {
    const float x = 2.2f + 2.6f * random.next_float(), y = 6.2f + 2.4f * random.next_float();
    const float size = 0.18f + 0.4f * random.next_float() * random.next_float();
    const Mesh rock = rough_stone({size * 1.3f, size, size * 0.8f}, size * 0.24f, size * 0.12f, 8,
                                  static_cast<std::uint32_t>(i + 80));
    scene.add(m.stone, placed(numbered(rock, 23 * i),
                              pose({x, y, terrain(x, y) + 0.15f * size}, 360 * random.next_float())));
  }
}

}  // namespace

Scene build_tree() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  add_land(scene, m);
  add_grass(scene, m);
  add_fence(scene, m);
  const Vec3 foot = kTreeFoot + Vec3(0, 0, terrain(kTreeFoot.x(), kTreeFoot.y()) - 0.08f);
  const TreeMeshes tree = grow_tree(foot, {.bare_share = 0.38f, .leaves_per_twig = 6, .seed = 4});
  scene.add(m.bark, tree.branches);
  scene.add(m.leaves, tree.leaves);
  add_swing(scene, m, foot);
  add_stones(scene, m);
  scene.finish(result);
  result.id = "tree";
  result.title = "Tree";
  result.description =
      "Leaves and thin branches before a smooth sky: structures of one or two pixels are lost, and "
      "background unseen "
      "through holes in the foliage is restored without a visible fault.";
  result.sun =
      Sun{.direction = Vec3(-0.62f, -0.52f, 0.59f).normalized(), .illuminance_lx = {106000, 97000, 82000}};
  result.sky = {.kind = Sky::Kind::kGradient,
                .zenith_cd_m2 = {2600, 4300, 7600},
                .horizon_cd_m2 = {7600, 8900, 10400},
                .ground_cd_m2 = {900, 1200, 500}};
  result.camera = camera_along_y({0, 0, 1.75f}, 66, 8);
  result.quick = quick_views(0.32, 0.24, 16);
  result.paper = paper_views(0.12, 9, 256);
  result.max_bounces = 2;
  return result;
}

}  // namespace plenolab
