#include "stimuli/scenes/modelling/stationery.h"

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {
namespace {

constexpr float kTurn = 2 * static_cast<float>(EIGEN_PI);

Material metal(Rgb reflectance, float roughness) {
  return {.kind = Material::Kind::kMetal, .albedo = plain(reflectance), .roughness = constant(roughness)};
}

Eigen::Affine3f lying() {
  return Eigen::Affine3f(Eigen::AngleAxisf(kTurn / 4, Vec3::UnitY()));
}

/// Half circle about (x, y) at height z from one angle to another, as points of a wire.
void bend(std::vector<Vec3>& path, float x, float y, float z, float radius, float from, float to) {
  constexpr int kPieces = 10;
  for (int i = 0; i <= kPieces; ++i) {
    const float angle = from + (to - from) * static_cast<float>(i) / kPieces;
    path.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle), z});
  }
}

}  // namespace

StationeryMaterials stationery_materials(SceneAssembler& scene) {
  StationeryMaterials m{};
  m.steel = scene.material(metal({0.62f, 0.61f, 0.6f}, 0.02f));
  m.brass = scene.material(metal({0.86f, 0.66f, 0.32f}, 0.03f));
  m.copper = scene.material(metal({0.9f, 0.55f, 0.42f}, 0.08f));
  m.gold = scene.material(metal({0.95f, 0.75f, 0.38f}, 0.03f));
  m.chrome = scene.material({.kind = Material::Kind::kMirror, .albedo = plain({0.6f, 0.61f, 0.62f})});
  m.glass = scene.material({.kind = Material::Kind::kDielectric, .ior = 1.5f});
  m.enamel = scene.material(glossy(plain({0.8f, 0.78f, 0.7f}), constant(0.05f), 1.5f));
  m.lacquer_black = scene.material(glossy(plain({0.012f, 0.012f, 0.014f}), constant(0.03f), 1.5f));
  m.lacquer_red = scene.material(glossy(plain({0.35f, 0.02f, 0.02f}), constant(0.03f), 1.5f));
  m.lacquer_blue = scene.material(glossy(plain({0.02f, 0.05f, 0.25f}), constant(0.03f), 1.5f));
  return m;
}

Mesh paper_clip(float length_m) {
  const float l = length_m, r = 0.13f * l, z = 0.025f * l;
  std::vector<Vec3> path{{-0.25f * l, r, z}};
  bend(path, 0.5f * l - r, 0, z, r, kTurn / 4, -kTurn / 4);
  bend(path, -0.5f * l + r, 0.12f * r, z, 1.12f * r, -kTurn / 4, -3 * kTurn / 4);
  bend(path, 0.38f * l - r, 0.24f * r, 1.6f * z, 0.9f * r, kTurn / 4, -kTurn / 4);
  path.push_back({-0.12f * l, -0.66f * r, 1.6f * z});
  return tube(path, std::vector<float>(path.size(), 0.025f * l), 10);
}

Mesh screw(float length_m) {
  const float l = length_m, core = 0.075f * l;
  std::vector<std::array<float, 2>> profile{
      {0.f, 0.f}, {0.17f * l, 0.f}, {0.175f * l, 0.02f * l}, {core, 0.12f * l}};
  constexpr int kThreads = 14;
  for (int i = 0; i < kThreads; ++i) {
    const float z = l * (0.16f + 0.7f * static_cast<float>(i) / kThreads);
    profile.push_back({core, z});
    profile.push_back({1.45f * core, z + 0.02f * l});
    profile.push_back({core, z + 0.04f * l});
  }
  profile.push_back({0.f, l});
  Eigen::Affine3f at = Eigen::Translation3f(0, 0, 0.13f * l) * lying();
  return placed(lathe(profile, 20), at);
}

Mesh coin(float diameter_m) {
  const float r = diameter_m / 2, h = 0.08f * diameter_m;
  const std::array<std::array<float, 2>, 8> profile{{{0.f, 0.f},
                                                     {0.97f * r, 0.f},
                                                     {r, 0.12f * h},
                                                     {r, 0.9f * h},
                                                     {0.96f * r, h},
                                                     {0.9f * r, h},
                                                     {0.86f * r, 0.86f * h},
                                                     {0.f, 0.9f * h}}};
  return lathe(profile, 36);
}

Mesh drawing_pin(float diameter_m) {
  const float r = diameter_m / 2;
  std::vector<std::array<float, 2>> profile{{0.f, 0.f}};
  for (int i = 1; i <= 6; ++i) {
    const float t = static_cast<float>(i) / 6;
    profile.push_back({r * std::sin(t * kTurn / 4), 0.45f * r * (1 - std::cos(t * kTurn / 4))});
  }
  profile.push_back({0.12f * r, 0.42f * r});
  profile.push_back({0.1f * r, 0.6f * r});
  profile.push_back({0.f, 2.1f * r});
  return lathe(profile, 24);
}

void add_pen(SceneAssembler& scene, int barrel, int metal, const Eigen::Affine3f& at, float length_m) {
  const float l = length_m, r = 0.038f * l;
  const Eigen::Affine3f flat = at * Eigen::Translation3f(-l / 2, 0, 1.15f * r) * lying();
  const std::array<std::array<float, 2>, 5> nib{
      {{0.f, 0.f}, {0.1f * r, 0.f}, {0.3f * r, 0.04f * l}, {0.8f * r, 0.12f * l}, {0.86f * r, 0.14f * l}}};
  const std::array<std::array<float, 2>, 6> body{{{0.86f * r, 0.14f * l},
                                                  {r, 0.3f * l},
                                                  {1.05f * r, 0.55f * l},
                                                  {1.05f * r, 0.9f * l},
                                                  {0.9f * r, 0.985f * l},
                                                  {0.f, l}}};
  scene.add(metal, placed(lathe(nib, 28), flat));
  scene.add(barrel, placed(lathe(body, 28), flat));
  for (const float z : {0.56f, 0.6f, 0.93f}) {
    const std::array<std::array<float, 2>, 4> ring{{{1.0f * r, z * l},
                                                    {1.14f * r, (z + 0.003f) * l},
                                                    {1.14f * r, (z + 0.015f) * l},
                                                    {1.0f * r, (z + 0.018f) * l}}};
    scene.add(metal, placed(lathe(ring, 28), flat));
  }
  const std::array clip{Vec3(flat * Vec3(-1.05f * r, 0, 0.94f * l)),
                        Vec3(flat * Vec3(-1.5f * r, 0, 0.9f * l)),
                        Vec3(flat * Vec3(-1.2f * r, 0, 0.66f * l))};
  scene.add(metal, tube(clip, std::array{0.22f * r, 0.2f * r, 0.26f * r}, 10));
}

Mesh tumbler(float height_m) {
  const float h = height_m;
  const std::array<std::array<float, 2>, 12> profile{{{0.f, 0.f},
                                                      {0.30f * h, 0.f},
                                                      {0.315f * h, 0.02f * h},
                                                      {0.33f * h, 0.3f * h},
                                                      {0.36f * h, 0.98f * h},
                                                      {0.355f * h, h},
                                                      {0.335f * h, h},
                                                      {0.33f * h, 0.98f * h},
                                                      {0.30f * h, 0.3f * h},
                                                      {0.28f * h, 0.14f * h},
                                                      {0.2f * h, 0.11f * h},
                                                      {0.f, 0.1f * h}}};
  return lathe(profile, 64);
}

void add_watch(SceneAssembler& scene, int metal, int dial, int hands, const Eigen::Affine3f& at) {
  constexpr float kRadius = 0.024f, kHigh = 0.009f;
  const std::array<std::array<float, 2>, 7> body{{{0.f, 0.f},
                                                  {0.7f * kRadius, 0.f},
                                                  {0.97f * kRadius, 0.3f * kHigh},
                                                  {kRadius, 0.6f * kHigh},
                                                  {0.96f * kRadius, kHigh},
                                                  {0.9f * kRadius, kHigh},
                                                  {0.87f * kRadius, 0.86f * kHigh}}};
  scene.add(metal, placed(lathe(body, 64), at));
  const std::array<std::array<float, 2>, 2> face{{{0.88f * kRadius, 0.86f * kHigh}, {0.f, 0.86f * kHigh}}};
  scene.add(dial, placed(lathe(face, 64), at));
  const auto mark = [&](float turn, float from, float to, float thick) {
    const Vec3 out(std::cos(turn) * kRadius, std::sin(turn) * kRadius, 0), up(0, 0, 0.88f * kHigh);
    scene.add(hands, rod(at * Vec3(from * out + up), at * Vec3(to * out + up), thick, thick, 6));
  };
  for (int hour = 0; hour < 12; ++hour) mark(kTurn * static_cast<float>(hour) / 12, 0.7f, 0.8f, 0.0003f);
  mark(0.6f, -0.1f, 0.62f, 0.0004f);
  mark(2.2f, -0.1f, 0.42f, 0.0005f);
  scene.add(metal, rod(at * Vec3(kRadius, 0, 0.5f * kHigh), at * Vec3(1.3f * kRadius, 0, 0.5f * kHigh),
                       0.003f, 0.0035f, 16));
}

Mesh washer(float diameter_m) {
  const float r = diameter_m / 2, h = 0.1f * diameter_m;
  const std::array<std::array<float, 2>, 5> profile{
      {{0.45f * r, 0.f}, {r, 0.f}, {r, h}, {0.45f * r, h}, {0.45f * r, 0.f}}};
  // Flat faces: their highlights flash, where rounded ones would only wander.
  Mesh mesh;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    append(mesh, lathe(std::array{profile[i], profile[i + 1]}, 28));
  return mesh;
}

namespace {

/// Clips, screws, washers, pins, coins and steel balls in loose heaps.
void scatter(SceneAssembler& scene, const StationeryMaterials& m) {
  RandomStream random(71, 0x7363726e, 0);
  const auto around = [&](float centre, float reach) {
    return centre + reach * (random.next_float() + random.next_float() - 1);
  };
  constexpr std::array<std::array<float, 3>, 5> kHeaps{{{0.26f, 0.55f, 0.1f},
                                                        {-0.3f, 0.56f, 0.12f},
                                                        {0.42f, 0.86f, 0.12f},
                                                        {-0.06f, 1.08f, 0.16f},
                                                        {0.02f, 0.5f, 0.3f}}};
  for (int i = 0; i < 150; ++i) {
    const auto& [x, y, reach] = kHeaps[static_cast<std::size_t>(i) % kHeaps.size()];
    const Eigen::Affine3f at = pose({around(x, reach), around(y, reach), 0.0062f}, 360 * random.next_float());
    const int kind = i % 6;
    if (kind < 2) scene.add(i % 4 == 0 ? m.copper : m.steel, placed(paper_clip(0.042f), at));
    if (kind == 2)
      scene.add(i % 4 == 0 ? m.brass : m.steel, placed(screw(0.024f + 0.012f * random.next_float()), at));
    if (kind == 3) scene.add(m.gold, placed(drawing_pin(0.0105f), at));
    if (kind == 4)
      scene.add(m.chrome,
                placed(ellipsoid({0.004f, 0.004f, 0.004f}, 20), at * Eigen::Translation3f(0, 0, 0.004f)));
    if (kind == 5) scene.add(m.steel, placed(drawing_pin(0.009f), at));
  }
  for (int i = 0; i < 130; ++i) {
    const auto& [x, y, reach] = kHeaps[static_cast<std::size_t>(i) % kHeaps.size()];
    const Vec3 lean(0.24f * (random.next_float() - 0.5f), 0.24f * (random.next_float() - 0.5f), 1);
    const Eigen::Affine3f at = Eigen::Translation3f(around(x, reach), around(y, reach), 0.0075f) *
                               Eigen::Quaternionf::FromTwoVectors(Vec3::UnitZ(), lean) *
                               Eigen::Affine3f::Identity();
    const float size = 0.007f + 0.005f * random.next_float();
    scene.add(i % 3 == 0 ? m.brass : m.steel, placed(washer(size), at));
  }
  for (int i = 0; i < 16; ++i) {
    const float tilt = 0.05f * (random.next_float() - 0.5f);
    const Eigen::Affine3f at =
        pose({around(-0.47f, 0.12f), around(0.72f, 0.12f), 0.004f + 0.0018f * static_cast<float>(i % 4)}) *
        Eigen::AngleAxisf(tilt, Vec3::UnitX());
    scene.add(i % 3 == 0 ? m.copper : (i % 3 == 1 ? m.brass : m.steel),
              placed(coin(0.018f + 0.008f * random.next_float()), at));
  }
}

}  // namespace

void add_stationery(SceneAssembler& scene, const StationeryMaterials& m) {
  scatter(scene, m);
  add_pen(scene, m.lacquer_black, m.gold, pose({0.08f, 0.66f, 0.0075f}, 38), 0.14f);
  add_pen(scene, m.chrome, m.chrome, pose({0.33f, 0.68f, 0.0055f}, -62), 0.138f);
  add_pen(scene, m.lacquer_red, m.chrome, pose({-0.19f, 0.79f, 0.0065f}, 71), 0.13f);
  add_pen(scene, m.lacquer_blue, m.brass, pose({-0.2f, 0.5f, 0.002f}, 14), 0.142f);
  add_watch(scene, m.gold, m.enamel, m.lacquer_black, pose({0.2f, 0.62f, 0.0075f}, 130));
  scene.add(m.glass, placed(tumbler(0.11f), Vec3(0.44f, 1.0f, 0.001f)));
  scene.add(m.glass, placed(ellipsoid({0.03f, 0.03f, 0.03f}, 64), Vec3(-0.52f, 0.95f, 0.031f)));
}

}  // namespace plenolab
