// Boats and Lanterns: the blue hour in a small harbour. Paper lanterns hang along a jetty and from a mast and
// float on rippled water that reflects them. Small bright lights before a dark ground: a dynamic range of
// 10⁵, and reflections broken up by ripples, which the denser camera grid reproduces well.
//
// Light: lanterns 2 000–8 000 cd/m², sky 0.1 cd/m² overhead to 0.8 cd/m² at the horizon, moon 3 000 cd/m²
// (0.2 lx), windows on the far shore 60–150 cd/m²; water 0.05–2 cd/m² between reflections.

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/harbour.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

struct Materials {
  int water, deck, pile, blue, red, white, inside, rope, hill, forest, wall, roof, window, cap;
  std::vector<LanternMaterials> lanterns;
};

/// Slope of the water: crossing wavelets, calmer far away where they would be finer than a pixel.
Vec3 water_normal(const SurfacePoint& point) {
  const float x = point.position_m.x(), y = point.position_m.y();
  const float calm = 1 / (1 + 0.02f * y);
  float slope_x = 0, slope_y = 0, scale = 0.55f, height = 0.034f;
  for (std::uint32_t octave = 0; octave < 4; ++octave) {
    slope_x += height * gradient_noise({x * scale * 1.2f, y * scale, 0.5f}, 200 + octave);
    slope_y += height * gradient_noise({x * scale, y * scale * 1.6f, 7.5f}, 300 + octave);
    scale *= 2.3f;
    height *= 0.72f;
  }
  return Vec3(-slope_x * calm, -slope_y * calm, 1).normalized();
}

ColourTexture painted(Rgb paint, std::uint32_t seed) {
  const ColourTexture below = wood({.weathering = 0.5f, .seed = seed});
  return [=](const SurfacePoint& point) {
    const float worn = fractal_noise(point.position_m * 9, 4, seed);
    const float strake =
        0.85f + 0.15f * smooth_step(0, 0.02f, std::abs(std::fmod(std::abs(part_of(point).u), 0.16f)));
    return mix(paint * strake, below(point), smooth_step(0.32f, 0.5f, worn));
  };
}

Materials make_materials(SceneAssembler& scene) {
  Materials m{};
  m.water = scene.material(glossy(plain({0.003f, 0.008f, 0.011f}), constant(0.035f), 1.33f, water_normal));
  m.deck = scene.material(diffuse(wood({.light = {0.50f, 0.42f, 0.33f},
                                        .dark = {0.22f, 0.17f, 0.13f},
                                        .ring_m = 0.03f,
                                        .weathering = 0.5f,
                                        .seed = 5})));
  m.pile = scene.material(diffuse(wood({.light = {0.34f, 0.26f, 0.19f},
                                        .dark = {0.12f, 0.09f, 0.065f},
                                        .ring_m = 0.03f,
                                        .weathering = 0.4f,
                                        .seed = 6})));
  m.blue = scene.material(diffuse(painted({0.06f, 0.17f, 0.3f}, 7)));
  m.red = scene.material(diffuse(painted({0.42f, 0.06f, 0.045f}, 8)));
  m.white = scene.material(diffuse(painted({0.66f, 0.65f, 0.6f}, 9)));
  m.inside = scene.material(diffuse(wood({.light = {0.55f, 0.37f, 0.2f},
                                          .dark = {0.25f, 0.14f, 0.07f},
                                          .ring_m = 0.03f,
                                          .weathering = 0.15f,
                                          .seed = 10})));
  m.rope = scene.material(diffuse(plain({0.4f, 0.33f, 0.23f})));
  m.hill = scene.material(diffuse(mottled({0.06f, 0.08f, 0.07f}, {0.1f, 0.11f, 0.09f}, 12, 0, 11)));
  m.forest = scene.material(diffuse(mottled({0.03f, 0.05f, 0.03f}, {0.06f, 0.08f, 0.05f}, 3, 0, 12)));
  m.wall = scene.material(diffuse(mottled({0.5f, 0.45f, 0.38f}, {0.4f, 0.34f, 0.28f}, 2, 0, 13)));
  m.roof = scene.material(diffuse(plain({0.16f, 0.07f, 0.05f})));
  m.window = scene.material(lamp({150, 96, 40}));
  m.cap = scene.material(diffuse(plain({0.04f, 0.03f, 0.025f})));
  const auto lantern = [&](Rgb belly) {
    return LanternMaterials{scene.material(lamp(belly)),
                            scene.material(lamp(belly * Rgb{0.5f, 0.42f, 0.32f})), m.cap};
  };
  m.lanterns = {lantern({7200, 4700, 1900}), lantern({7000, 3300, 850}), lantern({5600, 1250, 420}),
                lantern({6800, 4100, 1300})};
  return m;
}

void add_water(SceneAssembler& scene, const Materials& m) {
  scene.add(m.water, surface(1, 1, [](float u, float v) { return Vec3(1200 * u - 600, 900 * v - 20, 0); }));
}

/// Jetty that runs into the picture from the left foreground, with tall posts for the lanterns.
void add_jetty(SceneAssembler& scene, const Materials& m) {
  constexpr float kLeft = -3.5f, kRight = -1.75f, kDeck = 0.62f, kEnd = 19;
  RandomStream random(31, 0x6a657474, 0);
  int number = 0;
  for (float y = -1; y < kEnd; y += 0.165f) {
    const float stick = 0.08f * random.next_float();
    const Mesh plank = numbered(bevelled_box({kRight - kLeft + stick, 0.15f, 0.04f}, 0.006f), number += 11);
    scene.add(m.deck,
              placed(plank, pose({(kLeft + kRight) / 2 + stick / 2, y, kDeck + 0.006f * random.next_float()},
                                 1.2f * (random.next_float() - 0.5f))));
  }
  for (const float x : {kLeft + 0.2f, kRight - 0.2f}) {
    scene.add(m.pile, placed(numbered(bevelled_box({0.12f, kEnd + 1, 0.16f}, 0.01f), number += 3),
                             Vec3(x, (kEnd - 1) / 2, kDeck - 0.1f)));
  }
  Vec3 before_left = Vec3::Zero(), before_right = Vec3::Zero();
  for (int i = 0; i < 6; ++i) {
    const float y = 1.4f + 3.4f * static_cast<float>(i);
    const Vec3 left(kLeft - 0.02f, y, 3.0f), right(kRight + 0.04f, y, 2.85f + 0.12f * random.next_float());
    for (const Vec3& top : {left, right}) {
      const Vec3 foot(top.x() + 0.03f * random.next_float(), y, -0.6f);
      scene.add(m.pile, numbered(rod(foot, top + Vec3(0, 0, 0.15f), 0.085f, 0.065f, 14), number += 7));
    }
    if (i > 0) {
      add_lantern_rope(scene, m.rope, m.lanterns, {before_right, right, 0.38f, 3, 0.3f});
      add_lantern_rope(scene, m.rope, m.lanterns, {before_left, left, 0.42f, 2, 0.3f});
    }
    before_left = left;
    before_right = right;
  }
}

void add_mooring(SceneAssembler& scene, const Materials& m, const Vec3& from, const Vec3& to) {
  const std::vector<Vec3> path = hanging_line(from, to, 0.25f, 16);
  scene.add(m.rope, tube(path, std::vector<float>(path.size(), 0.014f), 6));
}

/// Mast with boom, furled sail and lines of lanterns to bow and stern.
void add_mast(SceneAssembler& scene, const Materials& m, const Eigen::Affine3f& at, const BoatLook& look) {
  const Vec3 step = at * Vec3(0, 0.35f, 0.1f), head = at * Vec3(0, 0.3f, 4.6f);
  scene.add(m.inside, numbered(rod(step, head, 0.06f, 0.035f, 12), 5));
  const Vec3 gooseneck = at * Vec3(0, 0.3f, 1.15f), boom_end = at * Vec3(0.15f, -1.9f, 1.3f);
  scene.add(m.inside, numbered(rod(gooseneck, boom_end, 0.04f, 0.03f, 10), 6));
  const std::array furled{Vec3(gooseneck + Vec3(0, 0, 0.1f)),
                          Vec3((gooseneck + boom_end) / 2 + Vec3(0, 0, 0.13f)),
                          Vec3(boom_end + Vec3(0, 0, 0.07f))};
  scene.add(m.white, tube(furled, std::array{0.11f, 0.12f, 0.05f}, 12));
  for (const float side : {-1.f, 1.f}) {
    const Vec3 chain = at * Vec3(side * look.beam_m * 0.47f, 0.2f, look.side_m);
    scene.add(m.rope, rod(chain, head - Vec3(0, 0, 0.2f), 0.006f, 0.006f, 4));
  }
  add_lantern_rope(scene, m.rope, m.lanterns,
                   {head, at * Vec3(boat_bow(look) + Vec3(0, 0.1f, 0.1f)), 0.3f, 4, 0.24f});
  add_lantern_rope(scene, m.rope, m.lanterns,
                   {head, at * Vec3(boat_stern(look) + Vec3(0, 0, 0.3f)), 0.4f, 4, 0.24f});
}

void add_boats(SceneAssembler& scene, const Materials& m) {
  const BoatLook dinghy{.length_m = 3.6f, .beam_m = 1.4f, .side_m = 0.42f, .number = 40};
  const Eigen::Affine3f near_pose = pose({-0.15f, 5.4f, 0}, 24);
  add_boat(scene, m.blue, m.inside, near_pose, dinghy);
  add_mooring(scene, m, near_pose * boat_bow(dinghy), {-1.75f, 8.2f, 0.8f});
  const BoatLook skiff{.length_m = 4.2f, .beam_m = 1.55f, .side_m = 0.48f, .number = 80};
  const Eigen::Affine3f skiff_pose = pose({0.15f, 10.4f, 0}, 62);
  add_boat(scene, m.white, m.inside, skiff_pose, skiff);
  add_mooring(scene, m, skiff_pose * boat_bow(skiff), {-1.75f, 11.6f, 0.8f});
  const BoatLook yawl{.length_m = 5.4f, .beam_m = 1.9f, .side_m = 0.62f, .number = 120};
  const Eigen::Affine3f yawl_pose = pose({4.1f, 12.6f, 0}, -68);
  add_boat(scene, m.red, m.inside, yawl_pose, yawl);
  add_mast(scene, m, yawl_pose, yawl);
  const BoatLook far{.length_m = 4.0f, .beam_m = 1.5f, .side_m = 0.45f, .number = 160};
  add_boat(scene, m.blue, m.inside, pose({1.4f, 19, 0}, 100), far);
  add_boat(scene, m.white, m.inside, pose({9.5f, 24, 0}, 30), far);
  for (const auto& [x, y] : {std::pair{-0.05f, 5.1f}, std::pair{0.3f, 10.5f}, std::pair{1.4f, 19.f}}) {
    add_lantern(scene, m.lanterns[0], {x, y, 0.72f}, 0.3f);
  }
}

/// Floating lanterns: paper round a candle on a raft.
void add_floating_lanterns(SceneAssembler& scene, const Materials& m) {
  RandomStream random(37, 0x666c6f61, 0);
  for (int i = 0; i < 26; ++i) {
    const float y = 5 + 30 * random.next_float() * random.next_float(),
                x = 0.9f + (0.1f + 0.42f * y) * random.next_float();
    const Eigen::Affine3f at = pose({x, y, 0}, 90 * random.next_float());
    scene.add(m.cap, placed(bevelled_box({0.2f, 0.2f, 0.04f}, 0.005f), at));
    const auto kind = static_cast<std::size_t>(i) % m.lanterns.size();
    scene.add(m.lanterns[kind].shoulder,
              placed(placed(bevelled_box({0.13f, 0.13f, 0.16f}, 0.01f), Vec3(0, 0, 0.1f)), at));
  }
}

void add_houses(SceneAssembler& scene, const Materials& m, RandomStream& random) {
  for (int i = 0; i < 16; ++i) {
    const float x = -85 + 11 * static_cast<float>(i) + 6 * random.next_float(),
                y = 132 + 10 * random.next_float();
    const float width = 6 + 4 * random.next_float(), height = 4 + 2.5f * random.next_float();
    scene.add(m.wall, placed(bevelled_box({width, 6, height}, 0.05f), Vec3(x, y, height / 2 + 1)));
    const std::array ridge{Vec3(x - width * 0.55f, y, height + 1.6f),
                           Vec3(x + width * 0.55f, y, height + 1.6f)};
    scene.add(m.roof, tube(ridge, std::array{3.1f, 3.1f}, 4));
    for (int w = 0; w < 3; ++w) {
      if (random.next_float() < 0.5f) continue;
      const float wx = x - width * 0.32f + width * 0.32f * static_cast<float>(w);
      scene.add(m.window, placed(upright_rectangle(-0.4f, 0.4f, -0.55f, 0.55f, 0),
                                 Vec3(wx, y - 3.05f, 1 + height * 0.5f)));
    }
  }
}

/// Wooded hills, trees and a few houses with lit windows.
void add_far_shore(SceneAssembler& scene, const Materials& m) {
  const auto shore = [](float distance, float height, std::uint32_t seed) {
    return [=](float u, float v) {
      const float x = (2 * u - 1) * distance * 1.2f;
      const float ridge = 0.55f + 0.6f * fractal_noise({x / distance * 2.6f, 0, 0}, 3, seed);
      const float trees = 0.10f * fractal_noise({x * 0.35f, v * 5, 0}, 3, seed + 9);
      return Vec3(x, distance + 60 * v,
                  -1 + height * (std::max(0.08f, ridge) + trees * v) * std::sin(1.57f * v));
    };
  };
  scene.add(m.forest, surface(600, 12, shore(128, 13, 5)));
  scene.add(m.hill, surface(400, 12, shore(420, 62, 6)));
  RandomStream random(41, 0x73686f72, 0);
  add_houses(scene, m, random);
}

}  // namespace

Scene build_boats() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  add_water(scene, m);
  add_jetty(scene, m);
  add_boats(scene, m);
  add_floating_lanterns(scene, m);
  add_far_shore(scene, m);
  scene.finish(result);
  result.id = "boats";
  result.title = "Boats and Lanterns";
  result.description =
      "Night with small bright lanterns: a very high dynamic range, and reflections on rippled water that a "
      "dense "
      "camera grid reproduces well.";
  result.sun =
      Sun{.direction = Vec3(0.34f, 0.88f, 0.235f).normalized(), .illuminance_lx = {0.24f, 0.205f, 0.15f}};
  result.sky = {.kind = Sky::Kind::kGradient,
                .zenith_cd_m2 = {0.025f, 0.09f, 0.36f},
                .horizon_cd_m2 = {0.52f, 0.78f, 1.6f},
                .ground_cd_m2 = {0.05f, 0.06f, 0.08f}};
  result.camera = camera_along_y({0, 0, 2.1f}, 64, -3.5f);
  result.quick = quick_views(0.07, 0.07, 16);
  result.paper = paper_views(0.04);
  result.max_bounces = 2;
  return result;
}

}  // namespace plenolab
