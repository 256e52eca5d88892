// Dunes: sand dunes in the last hour of a clear day. The cameras stand in the shadow of a sharp crest that
// climbs to the right, and the sun stands on that crest: the upper rows of the grid see the whole disc, the
// middle of the grid about half of it, the lower rows only its glow. Dust scatters light forwards into an
// aureole that falls by almost three decades within two degrees, so the peak luminance goes on changing when
// the disc is hidden: a real and gradual change of light, to which a tone mapping operator should adapt. Sky
// fills the upper border of every view.
//
// Light: direct sun of 30 000 lx (disc 4.5·10⁸ cd/m²), aureole 3·10⁷ cd/m² at the limb, daylight sky of
// turbidity 4; sunlit sand 1 000–6 000 cd/m², shaded sand 100–600 cd/m².

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/aureole.h"
#include "stimuli/scenes/modelling/desert.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

constexpr float kPi = static_cast<float>(EIGEN_PI);
constexpr float kEye = 1.7f;
constexpr float kSunAzimuthDeg = 11;  // from +y to the right
/// Of the sun's centre above the crest, as the middle camera sees it.
constexpr float kSunAboveCrestDeg = 0.05f;

struct Materials {
  int sand, far_sand, rock, trunk, palm, grass;
};

/// The crest of the near dune: where it runs and how high it is.
float crest_y(float x) {
  return 15.5f - 0.42f * (x - 3) + 1.6f * std::sin(0.21f * x + 0.4f) + 0.012f * std::pow(x - 3, 2.f);
}
float crest_height(float x) {
  const float rise = 0.1f + 5.8f / (1 + std::exp(-0.35f * (x - 2.4f)));
  return rise + 0.2f * gradient_noise({x * 0.16f, 0, 0}, 5);
}

/// Ground between the dunes.
float floor_height(float x, float y) {
  return 0.4f * fractal_noise({x * 0.07f, y * 0.07f, 0}, 2, 3) - 0.02f * std::max(0.f, y - 30);
}

float smooth_max(float a, float b, float width) {
  const float h = std::clamp(0.5f + 0.5f * (a - b) / width, 0.f, 1.f);
  return b + (a - b) * h + width * h * (1 - h);
}

/// The dune at `across` metres behind its crest: slip face at the angle of repose before it, a long back.
float land(float x, float y) {
  const float across = y - crest_y(x), top = crest_height(x);
  const float dune =
      across < 0 ? top + 0.6f * across : top * (1 - 0.5f * smooth_step(0, 26, across)) - 0.03f * across;
  // Tongues of slid sand down the slip face, none at its edge.
  const float tongues =
      gradient_noise({1.5f * x, 0.22f * y, 0}, 8) + 0.5f * gradient_noise({4 * x, 0.5f * y, 3}, 9);
  const float slid = across < 0 ? 0.09f * tongues * smooth_step(0, -1.6f, across) : 0;
  return smooth_max(dune + slid, floor_height(x, y), across < 0 ? 0.9f : 0.05f);
}

Rgb sand_colour(const SurfacePoint& point) {
  const Vec3& p = point.position_m;
  const float bank = 0.5f + 0.5f * fractal_noise(p * 0.12f, 3, 41);
  const float grain = 0.5f + 0.5f * gradient_noise(p * 190, 42);
  const float streak = 0.5f + 0.5f * gradient_noise({p.x() * 3, p.y() * 0.8f, p.z() * 6}, 43);
  return mix({0.50f, 0.33f, 0.185f}, {0.66f, 0.485f, 0.30f}, 0.6f * bank + 0.25f * streak + 0.15f * grain);
}

Rgb frond_colour(const SurfacePoint& point) {
  const int number = part_of(point).number;
  return mix({0.09f, 0.15f, 0.04f}, {0.30f, 0.27f, 0.11f}, cell_random(number, 0, 0, 46));
}

Rgb blade_colour(const SurfacePoint& point) {
  const PartPoint part = part_of(point);
  return mix({0.20f, 0.22f, 0.08f}, {0.52f, 0.44f, 0.22f},
             0.5f * part.v + 0.5f * cell_random(part.number, 0, 0, 47));
}

Materials make_materials(SceneAssembler& scene) {
  Materials m{};
  m.sand = scene.material(
      diffuse(sand_colour, sand_ripples({.along = Vec3(0.5f, -0.87f, 0).normalized(), .slope = 0.4f})));
  m.far_sand = scene.material(diffuse(mottled({0.60f, 0.44f, 0.29f}, {0.52f, 0.37f, 0.24f}, 40, 0, 44)));
  m.rock =
      scene.material(diffuse(stone({.light = {0.36f, 0.27f, 0.2f}, .dark = {0.17f, 0.12f, 0.09f}}),
                             bumpy({.height_m = 0.006f, .frequency_per_m = {25, 25, 25}, .octaves = 3})));
  m.trunk = scene.material(diffuse(mottled({0.26f, 0.19f, 0.12f}, {0.13f, 0.09f, 0.06f}, 0.15f, 0, 45)));
  m.palm = scene.material(diffuse(frond_colour));
  m.grass = scene.material(diffuse(blade_colour));
  return m;
}

/// The near land: rows of cells run along the crest, one of them exactly, so that its edge is sharp; cells
/// grow with the distance.
void add_near_land(SceneAssembler& scene, const Materials& m) {
  constexpr int kBefore = 240, kBehind = 60, kColumns = 420;
  const auto place = [](float u, float v) {
    const float side = 2 * u - 1, x = 3 + 45 * side * (0.2f + 0.8f * side * side);
    const float row = v * (kBefore + kBehind) - kBefore;
    const float t = row < 0 ? -row / kBefore : row / kBehind;
    const float across = row < 0 ? -(crest_y(x) + 6) * t : 60 * t * t;
    const float y = crest_y(x) + across;
    return Vec3(x, y, land(x, y));
  };
  scene.add(m.sand, surface(kColumns, kBefore + kBehind, place));
}

/// Chains of dunes behind, each a sharp-edged swell.
void add_far_dunes(SceneAssembler& scene, const Materials& m) {
  const std::array<float, 4> distances{85, 170, 380, 900};
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const float d = distances[i], layer = static_cast<float>(i);
    const auto chain = [d, layer](float u, float v) {
      const float x = (2 * u - 1) * 1.5f, y = 1 + 0.5f * v;
      const float wave = fractal_noise({x * 2.4f + 3.7f * layer, 0.35f * layer, 0}, 3, 61);
      const float top =
          0.018f + 0.012f * layer + 0.075f * (1 - std::abs(wave) * 1.4f) * (0.8f - 0.1f * layer);
      const float swell = v < 0.35f ? v / 0.35f : 1 - 0.6f * (v - 0.35f);
      const float shift = 0.12f * wave;
      return Vec3(x * d, (y + shift) * d, d * (-0.045f + top * swell));
    };
    scene.add(m.far_sand, surface(500, 20, chain));
  }
}

void add_palms(SceneAssembler& scene, const Materials& m) {
  constexpr std::array<std::array<float, 5>, 5> kPalms{{{-12.5f, 29, 7.2f, 0.9f, 200},
                                                        {-14.3f, 31, 8.4f, -0.7f, 30},
                                                        {-10.6f, 33, 6.2f, 0.6f, 100},
                                                        {-16.8f, 35, 6.8f, 1.2f, 160},
                                                        {-13.2f, 38, 5.0f, 0.5f, 300}}};
  std::uint32_t seed = 1;
  for (const auto& [x, y, height, lean, yaw] : kPalms) {
    add_palm(scene, m.trunk, m.palm, pose({x, y, land(x, y)}, yaw),
             {.height_m = height, .lean_m = lean, .seed = seed++});
  }
}

void add_near_things(SceneAssembler& scene, const Materials& m) {
  RandomStream random(29, 0x64756e65, 0);
  for (int i = 0; i < 26; ++i) {
    const float x = -7 + 12 * random.next_float(), y = 3.4f + 7 * random.next_float();
    const float size = 0.08f + 0.42f * std::pow(random.next_float(), 3.f);
    const Mesh rock = rough_stone({size * 1.4f, size, size * 0.75f}, size * 0.2f, size * 0.16f, 9,
                                  static_cast<std::uint32_t>(i + 20));
    scene.add(m.rock, placed(numbered(rock, 13 * i),
                             pose({x, y, land(x, y) + 0.1f * size}, 360 * random.next_float())));
  }
  constexpr std::array<std::array<float, 3>, 9> kTufts{{{1.75f, 2.9f, 0.75f},
                                                        {1.35f, 3.35f, 0.5f},
                                                        {2.3f, 3.7f, 0.6f},
                                                        {-2.6f, 4.6f, 0.5f},
                                                        {-3.1f, 5.0f, 0.62f},
                                                        {-5.8f, 8.2f, 0.6f},
                                                        {0.2f, 7.2f, 0.5f},
                                                        {4.4f, 7.0f, 0.65f},
                                                        {-8.5f, 12.5f, 0.7f}}};
  std::uint32_t seed = 1;
  for (const auto& [x, y, height] : kTufts) {
    const Mesh one = tuft({.blades = 70, .height_m = height, .spread_m = 0.75f * height, .seed = seed++});
    scene.add(m.grass, placed(one, Vec3(x, y, land(x, y))));
  }
}

/// Where the sun stands: on the crest as the middle camera sees it.
Vec3 sun_direction() {
  const float azimuth = kSunAzimuthDeg * kPi / 180;
  float horizon = 0;
  for (float d = 10; d < 60; d += 0.02f) {
    const float z = land(d * std::sin(azimuth), d * std::cos(azimuth)) - kEye;
    horizon = std::max(horizon, std::atan2(z, d));
  }
  const float elevation = horizon + kSunAboveCrestDeg * kPi / 180;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

}  // namespace

Scene build_dunes() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  result.sun = Sun{.direction = sun_direction(), .illuminance_lx = {38000, 29000, 16500}};
  result.sky.kind = Sky::Kind::kDaylight;
  result.sky.turbidity = 4;
  result.sky.ground_cd_m2 = {1500, 1100, 700};
  add_near_land(scene, m);
  add_far_dunes(scene, m);
  add_palms(scene, m);
  add_near_things(scene, m);
  add_aureole(scene, result, {.limb_cd_m2 = {3.6e7f, 2.9e7f, 1.9e7f}});
  scene.finish(result);
  result.id = "dunes";
  result.title = "Dunes";
  result.description =
      "The sun stands on the crest of a dune and is hidden by degrees along the camera grid: a gradual, real "
      "change of light to which tone mapping should adapt.";
  result.camera = camera_along_y({0, 0, kEye}, 62, 1.5f);
  result.quick = quick_views(0.24, 0.24, 32);
  result.paper = paper_views(0.12);
  result.max_bounces = 2;
  return result;
}

}  // namespace plenolab
