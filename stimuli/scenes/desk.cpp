// Desk: a writing desk in the evening under a lamp with a small bright bulb, strewn with things of polished
// metal and glass: pens, paper clips, drawing pins, screws, washers, coins, a pocket watch, a tumbler.
// Each sends one or a few tiny images of the bulb, brighter by orders of magnitude than what surrounds them
// and smaller than a pixel. They come and go from one view to the next, and the brightest of them decides the
// maximum of its view: outliers set the extremes, although the light of the scene does not change at all.
//
// Light: halogen bulb of 4.5·10⁶ cd/m² in a shade that hides it from the cameras, its lit lining 6 000 cd/m²,
// the ceiling behind the cameras 160 cd/m²; paper about 700 cd/m², wood 20–80 cd/m², the night in the window
// 0.01 cd/m² with lights of 190 cd/m²; highlights 10³–10⁵ cd/m² as pixels see them.

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/stationery.h"
#include "stimuli/scenes/modelling/textures.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

// x to the right, y away from the cameras at y = 0; the desk top is at z = 0.
constexpr float kWall = 1.75f;
const Vec3 kBulb{-0.32f, 0.98f, 0.34f};

struct Materials {
  StationeryMaterials things;
  int desk, wall, paper, blotter, shade_out, lining, bulb, ceiling, night, lights, frame;
  std::array<int, 5> books;
};

/// Squared paper with lines of handwriting.
Rgb paper_colour(const SurfacePoint& point) {
  const PartPoint part = part_of(point);
  constexpr float kLine = 0.009f;
  const float row = std::floor(part.v / kLine), within = part.v / kLine - row;
  const float ruled = std::abs(within - 0.1f) < 0.04f ? 0.75f : 1.f;
  const bool margin = std::abs(part.u) > 0.085f || std::abs(part.v) > 0.125f;
  const float word = gradient_noise({part.u * 70, row * 3.1f, 0}, 7);
  const float stroke = std::sin(part.u * 2600 + 5 * gradient_noise({part.u * 300, row, 0}, 8));
  const bool ink = !margin && word > -0.18f && std::abs(within - 0.4f - 0.16f * stroke) < 0.09f;
  return ink ? Rgb{0.05f, 0.06f, 0.2f} : Rgb{0.82f, 0.8f, 0.74f} * ruled;
}

Materials make_materials(SceneAssembler& scene) {
  Materials m{};
  m.things = stationery_materials(scene);
  m.desk = scene.material(diffuse(wood({.light = {0.30f, 0.17f, 0.085f},
                                        .dark = {0.14f, 0.07f, 0.03f},
                                        .ring_m = 0.018f,
                                        .weathering = 0.05f,
                                        .seed = 21})));
  m.wall = scene.material(diffuse(mottled({0.30f, 0.33f, 0.34f}, {0.25f, 0.28f, 0.30f}, 0.5f, 0, 22)));
  m.paper = scene.material(diffuse(paper_colour));
  m.blotter = scene.material(diffuse(mottled({0.05f, 0.12f, 0.09f}, {0.07f, 0.15f, 0.11f}, 0.04f, 0, 23)));
  m.shade_out = scene.material(glossy(plain({0.03f, 0.16f, 0.11f}), constant(0.15f), 1.5f));
  m.lining = scene.material(lamp({7500, 6000, 3800}));
  m.bulb = scene.material(lamp({5.7e6f, 4.35e6f, 2.6e6f}));
  m.ceiling = scene.material(lamp({190, 156, 108}));
  m.night = scene.material(diffuse(plain({0.01f, 0.012f, 0.02f})));
  m.lights = scene.material(lamp({260, 180, 90}));
  m.frame = scene.material(diffuse(plain({0.4f, 0.38f, 0.34f})));
  m.books = {scene.material(diffuse(plain({0.36f, 0.06f, 0.05f}))),
             scene.material(diffuse(plain({0.05f, 0.13f, 0.27f}))),
             scene.material(diffuse(plain({0.09f, 0.2f, 0.12f}))),
             scene.material(diffuse(plain({0.5f, 0.38f, 0.16f}))),
             scene.material(diffuse(plain({0.55f, 0.5f, 0.42f})))};
  return m;
}

void add_box(SceneAssembler& scene, int material, const Vec3& size, const Eigen::Affine3f& at,
             int number = 0) {
  const float bevel = std::min(0.003f, 0.2f * size.minCoeff());
  scene.add(material, placed(numbered(bevelled_box(size, bevel), number), at));
}

/// Desk top of boards, wall behind it, and a window with the lights of a city.
void add_room(SceneAssembler& scene, const Materials& m) {
  int number = 0;
  for (float y = 0.1f; y < kWall; y += 0.165f) {
    add_box(scene, m.desk, {2.4f, 0.1648f, 0.03f}, pose({0, y + 0.08f, -0.015f}), number += 9);
  }
  constexpr WallOpening kWindow{0.12f, 0.95f, 0.22f, 1.3f};
  const auto panel = [&](float x0, float x1, float z0, float z1) {
    scene.add(m.wall, upright_rectangle(x0, x1, z0, z1, kWall));
  };
  panel(-2.5f, kWindow.x0, -0.8f, 2);
  panel(kWindow.x1, 2.5f, -0.8f, 2);
  panel(kWindow.x0, kWindow.x1, -0.8f, kWindow.z0);
  panel(kWindow.x0, kWindow.x1, kWindow.z1, 2);
  const float middle = (kWindow.x0 + kWindow.x1) / 2, tall = (kWindow.z0 + kWindow.z1) / 2;
  for (const float x : {kWindow.x0, middle, kWindow.x1}) {
    add_box(scene, m.frame, {0.045f, 0.05f, kWindow.z1 - kWindow.z0}, pose({x, kWall, tall}));
  }
  add_box(scene, m.frame, {kWindow.x1 - kWindow.x0 + 0.16f, 0.14f, 0.03f},
          pose({middle, kWall - 0.03f, kWindow.z0}));
  // The lit ceiling of the room behind the cameras.
  scene.add(m.ceiling,
            surface(1, 1, [](float u, float v) { return Vec3(3.2f * u - 1.6f, 1.2f - 2.4f * v, 1.8f); }));
  RandomStream random(61, 0x63697479, 0);
  for (int house = 0; house < 16; ++house) {
    const float x = -6 + 2.4f * static_cast<float>(house), top = -1 + 7 * random.next_float();
    const Vec3 size(2.2f, 2, top + 12);
    scene.add(m.night, placed(bevelled_box(size, 0.02f), Vec3(x, 31, top - size.z() / 2)));
    for (int i = 0; i < 26; ++i) {
      const float wx = x - 0.85f + 0.45f * std::floor(4.4f * random.next_float()),
                  wz = top - 0.6f * std::floor(1 + 11 * random.next_float());
      scene.add(m.lights, upright_rectangle(wx, wx + 0.22f, wz, wz + 0.3f, 29.95f));
    }
  }
}

/// Brass foot and stem, enamelled shade with a lit lining, a small bulb that no camera sees.
void add_lamp(SceneAssembler& scene, const Materials& m) {
  const int brass = m.things.brass;
  const Vec3 foot(kBulb.x() - 0.09f, kBulb.y() + 0.09f, 0);
  const std::array<std::array<float, 2>, 7> base{{{0.0f, 0.0f},
                                                  {0.085f, 0.0f},
                                                  {0.088f, 0.008f},
                                                  {0.07f, 0.02f},
                                                  {0.03f, 0.028f},
                                                  {0.014f, 0.045f},
                                                  {0.009f, 0.06f}}};
  scene.add(brass, placed(lathe(base, 48), foot));
  const std::array arm{Vec3(foot + Vec3(0, 0, 0.05f)), Vec3(foot + Vec3(0, 0, 0.29f)),
                       Vec3(foot + Vec3(0.02f, -0.02f, 0.39f)), Vec3(foot + Vec3(0.055f, -0.055f, 0.445f)),
                       Vec3(kBulb + Vec3(0, 0, 0.11f))};
  scene.add(brass, tube(arm, std::array{0.009f, 0.008f, 0.008f, 0.008f, 0.008f}, 20));
  const auto shade = [&](float inset) {
    return std::array<std::array<float, 2>, 6>{{{0.02f, 0.105f - inset},
                                                {0.05f, 0.1f - inset},
                                                {0.09f, 0.07f - inset},
                                                {0.118f, 0.025f - inset},
                                                {0.132f, -0.02f},
                                                {0.134f, -0.028f}}};
  };
  scene.add(m.shade_out, placed(lathe(shade(0), 64), kBulb));
  scene.add(m.lining, placed(lathe(shade(0.003f), 64), kBulb));
  scene.add(m.bulb, placed(ellipsoid({0.006f, 0.006f, 0.008f}, 24), Vec3(kBulb + Vec3(0, 0, 0.02f))));
}

/// Blotter, sheets of paper, books on end and a flat pile of them.
void add_paper(SceneAssembler& scene, const Materials& m) {
  add_box(scene, m.blotter, {0.68f, 0.46f, 0.004f}, pose({0.02f, 0.72f, 0.002f}, 2));
  add_box(scene, m.paper, {0.21f, 0.297f, 0.0012f}, pose({-0.04f, 0.68f, 0.005f}, -9), 3);
  add_box(scene, m.paper, {0.21f, 0.297f, 0.0012f}, pose({0.17f, 0.78f, 0.0062f}, 17), 90);
  float z = 0;
  for (int i = 0; i < 3; ++i) {
    const float thick = 0.028f + 0.006f * static_cast<float>(i);
    add_box(scene, m.books[static_cast<std::size_t>(i)], {0.24f, 0.17f, thick},
            pose({0.58f, 1.12f, z + thick / 2}, 8.f - 13.f * static_cast<float>(i)));
    z += thick;
  }
  RandomStream random(67, 0x626f6f6b, 0);
  float x = -0.98f;
  while (x < -0.52f) {
    const float thick = 0.018f + 0.028f * random.next_float(), tall = 0.19f + 0.1f * random.next_float();
    add_box(scene, m.books[static_cast<std::size_t>(5 * random.next_float())], {thick, 0.17f, tall},
            pose({x + thick / 2, 1.4f, tall / 2}));
    x += thick + 0.001f;
  }
}

}  // namespace

Scene build_desk() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  add_room(scene, m);
  add_lamp(scene, m);
  add_paper(scene, m);
  add_stationery(scene, m.things);
  scene.finish(result);
  result.id = "desk";
  result.title = "Desk";
  result.description =
      "Many tiny highlights on metal and glass under a desk lamp come and go between neighbouring views: "
      "outliers decide the extremes although the light does not change.";
  result.sky = {.kind = Sky::Kind::kGradient,
                .zenith_cd_m2 = {0.3f, 0.4f, 0.8f},
                .horizon_cd_m2 = {1.6f, 1.3f, 1.3f},
                .ground_cd_m2 = {0.6f, 0.45f, 0.3f}};
  result.caustics = false;
  result.camera = camera_along_y({0, 0.06f, 0.45f}, 64, -21);
  result.quick = quick_views(0.03, 0.03, 32);
  result.paper = paper_views(0.015);
  result.max_bounces = 3;
  return result;
}

}  // namespace plenolab
