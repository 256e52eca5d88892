// Tunnel: a wet, abandoned service tunnel with lamps that leads to a bright end. The lining is glazed brick
// under a film of water and the floor is full of puddles: mirror-like reflections of lamps and daylight,
// whose disparity is not that of the wall they appear on, so that view synthesis shows ghost copies of them.
//
// Light: overcast daylight of 2 500–4 300 cd/m² at the far end, tube lamps of 13 000 cd/m² (warm white);
// lining about 1–100 cd/m².

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/recording.h"
#include "stimuli/scenes/modelling/textures.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

constexpr float kPi = static_cast<float>(EIGEN_PI);
constexpr float kHalfWidth = 2.4f, kSpring = 2.25f;  // the vault springs from walls of this height
constexpr float kStart = -3, kEnd = 34;
constexpr float kBrickLength = 0.3f, kBrickHeight = 0.1f;

struct Materials {
  int lining, floor, kerb, steel, rust, lamp, housing, cable, grass, rock, trunk, leaves;
};

/// Distance along the cross-section from the left foot over the vault to the right foot, and its inverse.
float section_length() {
  return 2 * kSpring + kPi * kHalfWidth;
}

Vec3 on_lining(float along_section, float y, float inset = 0) {
  const float arc = along_section - kSpring;
  if (arc < 0) return {-kHalfWidth + inset, y, along_section};
  if (arc > kPi * kHalfWidth) return {kHalfWidth - inset, y, section_length() - along_section};
  const float angle = kPi - arc / kHalfWidth, radius = kHalfWidth - inset;
  return {radius * std::cos(angle), y, kSpring + radius * std::sin(angle)};
}

struct Brick {
  float edge;  ///< distance to the nearest joint in metres
  float tone;  ///< random number of the brick
};

/// Bricks in stretcher bond; u runs along the tunnel, v up the section.
Brick brick_at(float along, float up) {
  const float course = std::floor(up / kBrickHeight);
  const float shifted = along + (std::fmod(std::abs(course), 2.f) < 0.5f ? 0 : kBrickLength / 2);
  const float column = std::floor(shifted / kBrickLength);
  const float dx = shifted - column * kBrickLength, dz = up - course * kBrickHeight;
  return {std::min({dx, kBrickLength - dx, dz, kBrickHeight - dz}),
          cell_random(static_cast<int>(column), static_cast<int>(course), 0, 71)};
}

/// Streaks of lime and algae that run down the section from the crown.
float streaks(const Vec3& p) {
  return 0.5f + 0.5f * fractal_noise({p.x() * 0.6f, p.y() * 1.7f, p.z() * 0.25f}, 4, 31);
}

Rgb lining_albedo(const SurfacePoint& point) {
  const Brick brick = brick_at(point.u, point.v);
  const Rgb glazed = mix({0.30f, 0.335f, 0.30f}, {0.50f, 0.51f, 0.44f}, brick.tone);
  const bool band = point.position_m.z() > 1.2f && point.position_m.z() < 1.52f;
  const Rgb face = band ? mix({0.07f, 0.15f, 0.13f}, {0.11f, 0.21f, 0.18f}, brick.tone) : glazed;
  const Rgb joint{0.13f, 0.12f, 0.10f};
  const float streak = streaks(point.position_m);
  const float dirt = smooth_step(0.35f, 0.9f, streak) * 0.75f;
  const float damp = 0.6f + 0.4f * smooth_step(0.0f, 0.9f, point.position_m.z());
  return mix(mix(joint, face, smooth_step(0.004f, 0.009f, brick.edge)), {0.115f, 0.10f, 0.07f}, dirt) * damp;
}

float lining_roughness(const SurfacePoint& point) {
  const float wet = smooth_step(0.85f, 0.5f, streaks(point.position_m));
  const float joint = smooth_step(0.009f, 0.004f, brick_at(point.u, point.v).edge);
  return 0.006f + 0.25f * (1 - wet) + 0.3f * joint;
}

/// Water film over brick: each brick tilts a little and the film waves.
Vec3 lining_normal(const SurfacePoint& point) {
  const Vec3& p = point.position_m;
  const Brick brick = brick_at(point.u, point.v);
  const float tilt = 0.002f;
  const Vec3 wave(gradient_noise(p * 5, 1), gradient_noise(p * 5, 2), gradient_noise(p * 5, 3));
  const Vec3 own(brick.tone - 0.5f, std::fmod(brick.tone * 7.3f, 1.f) - 0.5f,
                 std::fmod(brick.tone * 3.7f, 1.f) - 0.5f);
  return (point.normal + 0.002f * wave + tilt * own).normalized();
}

/// Depth of water on the floor in [0, 1]: puddles where the ground is low, above all in two wheel ruts, which
/// reflect the lamps of both walls.
float puddle(const Vec3& p) {
  const float beside_rut = (std::abs(p.x() + 0.2f) - 0.7f) / 0.35f;
  const float rut = 0.3f * std::exp(-beside_rut * beside_rut);
  const float low =
      fractal_noise({p.x() * 0.55f + 3.1f, p.y() * 0.3f, 0}, 4, 91) - 0.12f * std::abs(p.x()) + rut;
  return smooth_step(-0.1f, 0.02f, low);
}

Rgb floor_albedo(const SurfacePoint& point) {
  const Vec3& p = point.position_m;
  const float grit = 0.5f + 0.5f * fractal_noise(p * 22, 3, 15);
  const float speck = cellular_noise(p * 60, 4).cell;
  const Rgb asphalt = mix({0.05f, 0.05f, 0.048f}, {0.17f, 0.16f, 0.145f}, 0.65f * grit + 0.35f * speck);
  return asphalt * (1 - 0.7f * puddle(p));
}

float floor_roughness(const SurfacePoint& point) {
  return 0.006f + 0.35f * (1 - puddle(point.position_m));
}

Vec3 floor_normal(const SurfacePoint& point) {
  const Vec3& p = point.position_m;
  const float dry = 1 - puddle(p);
  const Vec3 ripple(gradient_noise(p * 7, 11), gradient_noise(p * 7, 12), 0);
  const Vec3 grit(gradient_noise(p * 60, 13), gradient_noise(p * 60, 14), 0);
  return (point.normal + 0.0008f * ripple + 0.10f * dry * grit).normalized();
}

Materials make_materials(SceneAssembler& scene) {
  Materials m{};
  m.lining = scene.material(glossy(lining_albedo, lining_roughness, 1.5f, lining_normal));
  m.floor = scene.material(glossy(floor_albedo, floor_roughness, 1.4f, floor_normal));
  m.kerb = scene.material(glossy(stone({.light = {0.34f, 0.33f, 0.31f}, .dark = {0.18f, 0.175f, 0.165f}}),
                                 constant(0.25f), 1.45f));
  m.steel = scene.material(
      glossy(mottled({0.16f, 0.2f, 0.22f}, {0.24f, 0.15f, 0.08f}, 0.3f, -0.25f, 17), constant(0.25f), 1.5f));
  m.rust = scene.material(diffuse(mottled({0.26f, 0.12f, 0.06f}, {0.1f, 0.07f, 0.05f}, 0.15f, 0, 18)));
  m.lamp = scene.material(lamp({15000, 12700, 9000}));
  m.housing = scene.material(diffuse(plain({0.06f, 0.065f, 0.065f})));
  m.cable = scene.material(diffuse(plain({0.035f, 0.035f, 0.04f})));
  m.grass = scene.material(diffuse(mottled({0.05f, 0.10f, 0.02f}, {0.13f, 0.15f, 0.05f}, 0.9f, 0, 19)));
  m.rock = scene.material(diffuse(mottled({0.24f, 0.22f, 0.19f}, {0.12f, 0.11f, 0.09f}, 0.5f, 0, 20)));
  m.trunk = scene.material(diffuse(bark({0.2f, 0.16f, 0.12f}, {0.06f, 0.05f, 0.04f}, 21)));
  m.leaves = scene.material(diffuse(mottled({0.05f, 0.12f, 0.025f}, {0.2f, 0.27f, 0.06f}, 0.4f, 0, 22)));
  return m;
}

void add_shell(SceneAssembler& scene, const Materials& m) {
  const float length = kEnd - kStart;
  const auto lining = [&](float u, float v) { return on_lining(v * section_length(), kStart + u * length); };
  Mesh vault = surface(40, 96, lining, {length, section_length()});
  scene.add(m.lining, vault);
  const auto road = [&](float u, float v) {
    const float x = kHalfWidth * (2 * u - 1), y = kStart + v * (length + 14);
    return Vec3(x, y, 0);
  };
  scene.add(m.floor, surface(2, 4, road));
  scene.add(m.housing, placed(upright_rectangle(-4, 4, 0, 6, 0), Vec3(0, kStart, 0)));
  RandomStream random(4, 0x6b657262, 0);
  int number = 0;
  for (const float side : {-1.f, 1.f}) {
    for (float y = kStart; y < kEnd; y += 0.9f) {
      const Mesh block =
          rough_stone({0.34f, 0.88f, 0.3f}, 0.025f, 0.006f, 5, static_cast<std::uint32_t>(++number));
      scene.add(m.kerb, placed(numbered(block, number * 31),
                               Vec3(side * (kHalfWidth - 0.15f), y, 0.01f * random.next_float())));
    }
  }
}

/// Ribs of the vault, every few metres.
void add_ribs(SceneAssembler& scene, const Materials& m) {
  for (float y = 2.5f; y < kEnd; y += 5.25f) {
    constexpr float kDepth = 0.16f, kWidth = 0.42f;
    const auto inner = [&](float u, float v) {
      return on_lining(v * section_length(), y + u * kWidth, kDepth);
    };
    scene.add(m.lining, surface(1, 96, inner, {kWidth, section_length()}));
    for (const float edge : {0.f, kWidth}) {
      const auto face = [&](float u, float v) {
        return on_lining(v * section_length(), y + edge, u * kDepth);
      };
      scene.add(m.lining, surface(1, 96, face, {kDepth, section_length()}));
    }
  }
}

void add_lamps(SceneAssembler& scene, const Materials& m) {
  int index = 0;
  for (float y = 5.3f; y < kEnd - 3; y += 5.25f, ++index) {
    for (const float side : {-1.f, 1.f}) {
      if (side > 0 && index == 2) continue;  // a lamp has failed
      const Vec3 place(side * 2.08f, y, 3.0f);
      const Eigen::Affine3f tilt = Eigen::Translation3f(place) *
                                   Eigen::AngleAxisf(side * 1.05f, Vec3::UnitY()) *
                                   Eigen::Affine3f::Identity();
      scene.add(m.lamp, placed(bevelled_box({0.18f, 1.3f, 0.06f}, 0.02f), tilt));
      scene.add(m.housing,
                placed(placed(bevelled_box({0.28f, 1.45f, 0.05f}, 0.01f), Vec3(0, 0, 0.058f)), tilt));
      for (const float end : {-0.5f, 0.5f}) {
        scene.add(m.cable,
                  rod(place + Vec3(0, end, 0.05f), place + Vec3(side * 0.3f, end, 0.2f), 0.015f, 0.015f, 6));
      }
    }
  }
}

/// Pipes and cables along the walls on brackets.
void add_services(SceneAssembler& scene, const Materials& m) {
  const auto pipe = [&](int material, float x, float z, float radius) {
    std::vector<Vec3> path;
    std::vector<float> radii;
    for (float y = kStart; y < kEnd + 0.2f; y += 0.25f) {
      const float sag = 0.012f * std::cos(2 * kPi * (y - 2.5f) / 2.625f);
      path.push_back({x, y, z + (radius < 0.03f ? sag * 2 : 0)});
      const bool flange = radius > 0.06f && std::fmod(y + 40, 4.5f) < 0.25f;
      radii.push_back(flange ? radius * 1.28f : radius);
    }
    scene.add(material, tube(path, radii, radius > 0.03f ? 24 : 8));
  };
  pipe(m.steel, -2.18f, 0.72f, 0.1f);
  pipe(m.rust, -2.25f, 0.45f, 0.045f);
  for (int i = 0; i < 4; ++i) pipe(m.cable, 2.27f, 0.45f + 0.075f * static_cast<float>(i), 0.018f);
  for (float y = 2.5f - 2.625f; y < kEnd; y += 2.625f) {
    scene.add(m.rust, placed(bevelled_box({0.3f, 0.05f, 0.03f}, 0.005f), Vec3(-2.27f, y, 0.59f)));
    scene.add(m.rust, placed(bevelled_box({0.04f, 0.05f, 0.36f}, 0.005f), Vec3(2.31f, y, 0.56f)));
  }
}

/// The far end: a cutting with rocks, grass and trees under the sky.
void add_outside(SceneAssembler& scene, const Materials& m) {
  RandomStream random(8, 0x6f757473, 0);
  for (const float side : {-1.f, 1.f}) {
    const auto bank = [&](float u, float v) {
      const float out = 14 * u, y = kEnd + 50 * v;
      const float bump = fractal_noise({out * 0.7f + side * 9, y * 0.7f, 0}, 4, 29);
      return Vec3(side * (kHalfWidth + 0.1f + out), y, 0.42f * out + 0.35f * bump * std::min(out, 1.f));
    };
    Mesh slope = surface(60, 120, bank);
    scene.add(m.grass, slope);
    for (int i = 0; i < 22; ++i) {
      const float out = 0.3f + 5 * random.next_float(), y = kEnd + 1 + 24 * random.next_float();
      const float size = 0.3f + 0.5f * random.next_float();
      scene.add(m.rock,
                placed(rough_stone({size, size, size * 0.7f}, size * 0.2f, size * 0.1f, 5,
                                   300u + static_cast<std::uint32_t>(i)),
                       pose({side * (kHalfWidth + out), y, 0.42f * out + 0.1f}, 360 * random.next_float())));
    }
  }
  const auto floor_end = [](float u, float v) {
    return Vec3(60 * (2 * u - 1), kEnd + 45 + 30 * v, -0.3f + 1.6f * v + 5 * std::abs(2 * u - 1));
  };
  scene.add(m.grass, surface(40, 20, floor_end));
}

void add_trees(SceneAssembler& scene, const Materials& m) {
  RandomStream random(9, 0x74726565, 0);
  for (int i = 0; i < 30; ++i) {
    const float side = i % 2 == 0 ? -1.f : 1.f;
    const float out = 2.5f + 9 * random.next_float(), y = kEnd + 14 + 34 * random.next_float();
    const float height = 4 + 4 * random.next_float();
    const Vec3 foot(side * (kHalfWidth + out), y, 0.4f * out);
    scene.add(m.trunk, rod(foot, foot + Vec3(0, 0, height * 0.5f), 0.14f, 0.08f, 8));
    Mesh crown = ellipsoid({height * 0.3f, height * 0.3f, height * 0.42f}, 56);
    for (Vec3& p : crown.positions_m) {
      p *= 1 + 0.5f * fractal_noise(p * (4 / height) + Vec3(static_cast<float>(7 * i), 0, 0), 4, 39);
    }
    smooth_normals(crown);
    scene.add(m.leaves, placed(crown, Vec3(foot + Vec3(0, 0, height * 0.7f))));
  }
}

}  // namespace

Scene build_tunnel() {
  Scene result;
  SceneAssembler scene;
  const Materials m = make_materials(scene);
  add_shell(scene, m);
  add_ribs(scene, m);
  add_lamps(scene, m);
  add_services(scene, m);
  add_outside(scene, m);
  add_trees(scene, m);
  scene.finish(result);
  result.id = "tunnel";
  result.title = "Tunnel";
  result.description =
      "Wet, mirror-like lining and puddles reflect lamps and a bright end: reflections have another "
      "disparity than the "
      "surface, so synthesised views show ghost copies of them.";
  result.sky = {.kind = Sky::Kind::kGradient,
                .zenith_cd_m2 = {2500, 2800, 3200},
                .horizon_cd_m2 = {4300, 4300, 4200},
                .ground_cd_m2 = {120, 130, 80}};
  result.portals.push_back({{-kHalfWidth, kEnd, 0}, {2 * kHalfWidth, 0, 0}, {0, 0, kSpring + kHalfWidth}});
  result.camera = camera_along_y({-0.35f, 0, 1.55f}, 68);
  result.quick = quick_views(0.16, 0.14, 16);
  result.paper = paper_views(0.1);
  result.max_bounces = 2;
  result.caustics = false;
  return result;
}

}  // namespace plenolab
