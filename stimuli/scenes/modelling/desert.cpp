#include "stimuli/scenes/modelling/desert.h"

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/noise.h"

namespace plenolab {
namespace {

constexpr float kTurn = 2 * static_cast<float>(EIGEN_PI);

/// Strip along a path: flat, `side` the direction of its width, tapering to a point.
Mesh blade_along(std::span<const Vec3> path, const Vec3& side, float width) {
  Mesh mesh;
  const auto last = static_cast<float>(path.size() - 1);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const float share = static_cast<float>(i) / last, half = width / 2 * (1 - share * share);
    for (const float across : {-1.f, 1.f}) {
      mesh.positions_m.push_back(path[i] + across * half * side);
      mesh.uvs.push_back({across * half, share});
    }
  }
  for (std::uint32_t i = 0; i + 1 < path.size(); ++i) {
    const std::uint32_t k = 2 * i;
    mesh.triangles.insert(mesh.triangles.end(), {{k, k + 1, k + 3}, {k, k + 3, k + 2}});
  }
  smooth_normals(mesh);
  return mesh;
}

/// Bends outwards from a point: first along `rise`, then down.
std::vector<Vec3> drooping(const Vec3& root, const Vec3& out, float length, float rise, float droop,
                           int pieces) {
  std::vector<Vec3> path;
  for (int i = 0; i <= pieces; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(pieces);
    path.push_back(root + length * (t * out + Vec3(0, 0, rise * t - droop * t * t)));
  }
  return path;
}

Mesh frond(const Vec3& root, const Vec3& out, float length, float rise, float droop) {
  constexpr int kPieces = 12, kLeaflets = 34;
  const std::vector<Vec3> rib = drooping(root, out, length, rise, droop, kPieces);
  std::vector<float> radii;
  for (int i = 0; i <= kPieces; ++i) radii.push_back(0.022f * (1.05f - static_cast<float>(i) / kPieces));
  Mesh mesh = tube(rib, radii, 4);
  for (int i = 3; i < kLeaflets; ++i) {
    const float t = static_cast<float>(i) / kLeaflets, at = t * kPieces;
    const auto k = std::min(static_cast<std::size_t>(at), rib.size() - 2);
    const Vec3 along = (rib[k + 1] - rib[k]).normalized();
    const Vec3 foot = rib[k] + (at - static_cast<float>(k)) * (rib[k + 1] - rib[k]);
    const Vec3 across = along.cross(Vec3::UnitZ()).normalized();
    const float size = length * 0.24f * std::sin(kTurn / 2 * (0.12f + 0.8f * t));
    for (const float side : {-1.f, 1.f}) {
      const Vec3 tip = foot + size * (side * across + 0.65f * along - Vec3(0, 0, 0.35f));
      const std::array path{foot, Vec3((foot + tip) / 2 + Vec3(0, 0, 0.05f * size)), tip};
      append(mesh, blade_along(path, along, 0.05f));
    }
  }
  return mesh;
}

}  // namespace

NormalTexture sand_ripples(const RippleLook& look) {
  return [look](const SurfacePoint& point) {
    const Vec3& p = point.position_m;
    const float x = p.dot(look.along), y = p.dot(Vec3(-look.along.y(), look.along.x(), 0));
    const float bend = 2.6f * gradient_noise({x * 0.5f, y * 0.28f, 0}, look.seed) +
                       0.8f * gradient_noise({x * 1.6f, y * 1.1f, 4}, look.seed + 1);
    const float phase = kTurn * (x / look.wavelength_m + bend);
    const float patch = 0.65f + 0.5f * gradient_noise({x * 0.17f, y * 0.17f, 8}, look.seed + 2);
    const float distance = p.norm() / look.fade_m;
    // The second harmonic makes the lee side steep and the windward side long.
    const float slope = look.slope * patch / (1 + distance * distance) *
                        (std::cos(phase) + 0.45f * std::cos(2 * phase + 0.9f));
    return Vec3((point.normal - slope * look.along).normalized());
  };
}

void add_palm(SceneAssembler& scene, int trunk, int leaves, const Eigen::Affine3f& at, const PalmLook& look) {
  RandomStream random(look.seed, 0x70616c6d, 0);
  std::vector<Vec3> path;
  std::vector<float> radii;
  constexpr int kRings = 40;
  for (int i = 0; i <= kRings; ++i) {
    const float t = static_cast<float>(i) / kRings;
    path.push_back({look.lean_m * t * t, 0, look.height_m * t - 0.3f * (1 - t)});
    const float ring = i % 2 == 0 ? 0.018f : 0.f;
    radii.push_back(0.17f - 0.05f * t + 0.1f * std::exp(-9 * t) + ring);
  }
  scene.add(trunk, placed(tube(path, radii, 12), at));
  for (int i = 0; i < look.fronds; ++i) {
    const float turn = 2.4f * static_cast<float>(i) + 0.3f * random.next_float();
    const float age = (static_cast<float>(i) + 0.5f) / static_cast<float>(look.fronds);
    const Vec3 out(std::cos(turn) * (0.45f + 0.5f * age), std::sin(turn) * (0.45f + 0.5f * age), 0);
    const float length = look.frond_m * (0.85f + 0.3f * random.next_float());
    scene.add(leaves,
              placed(numbered(frond(path.back(), out, length, 1.05f - 0.95f * age, 0.35f + 0.6f * age),
                              static_cast<int>(look.seed) * 31 + i),
                     at));
  }
}

Mesh tuft(const TuftLook& look) {
  RandomStream random(look.seed, 0x74756674, 0);
  Mesh mesh;
  for (int i = 0; i < look.blades; ++i) {
    const float turn = kTurn * random.next_float(), reach = 0.15f + 0.85f * random.next_float();
    const Vec3 out(std::cos(turn) * reach, std::sin(turn) * reach, 0);
    const float height = look.height_m * (0.5f + 0.5f * random.next_float());
    const Vec3 root = 0.2f * look.spread_m * out;
    std::vector<Vec3> path;
    for (int k = 0; k <= 4; ++k) {
      const float t = static_cast<float>(k) / 4;
      path.push_back(root + look.spread_m * t * t * out +
                     Vec3(0, 0, height * t * (1 - 0.35f * reach * t) - 0.02f));
    }
    append(mesh, numbered(blade_along(path, {-std::sin(turn), std::cos(turn), 0}, look.width_m), i));
  }
  return mesh;
}

}  // namespace plenolab
