#include "stimuli/scenes/modelling/harbour.h"

#include <algorithm>
#include <cmath>

namespace plenolab {
namespace {

constexpr float kPi = static_cast<float>(EIGEN_PI);

/// Half breadth at the gunwale for s from −1 (transom) to 1 (stem).
float half_breadth(const BoatLook& look, float s) {
  const float shape = s > 0 ? std::pow(std::max(0.f, 1 - std::pow(s, 2.1f)), 0.75f) : 1 - 0.34f * s * s;
  return look.beam_m / 2 * shape;
}

float gunwale_height(const BoatLook& look, float s) {
  return look.side_m * (1 + (s > 0 ? 0.62f : 0.18f) * s * s);
}

/// Point of the shell: a from −1 (port gunwale) over the keel to 1 (starboard), `inset` inside the planking.
Vec3 shell(const BoatLook& look, float s, float a, float inset) {
  constexpr float kStrakes = 6;
  const float round = std::abs(a) * kPi / 2;
  const float strake = std::abs(a) * kStrakes - std::floor(std::abs(a) * kStrakes);
  const float lap = 0.012f * (1 - strake);  // each plank overlaps the one below
  const float breadth = std::max(0.f, half_breadth(look, s) - inset);
  const float x = breadth * std::pow(std::sin(round), 0.85f) + (breadth > 0.05f ? lap : 0.f);
  const float keel = -look.draught_m + (s > 0 ? 0.3f * std::pow(s, 4.f) : 0.1f * s * s) + inset;
  const float z = keel + (gunwale_height(look, s) - keel) * (1 - std::cos(round));
  return {a < 0 ? -x : x, s * look.length_m / 2, z};
}

void add_gunwales(SceneAssembler& scene, int wood, const Eigen::Affine3f& at, const BoatLook& look) {
  for (const float side : {-1.f, 1.f}) {
    std::vector<Vec3> path;
    for (int i = 0; i <= 28; ++i) path.push_back(shell(look, -1 + static_cast<float>(i) / 14.1f, side, 0));
    const std::vector<float> radii(path.size(), 0.028f);
    scene.add(wood, placed(numbered(tube(path, radii, 8), look.number + 3), at));
  }
  std::vector<Vec3> stem;
  for (int i = 0; i <= 8; ++i)
    stem.push_back(shell(look, 0.995f, static_cast<float>(i) / 8, 0).cwiseProduct(Vec3(0, 1, 1)));
  stem.push_back(stem.back() + Vec3(0, 0.05f, 0.14f));
  scene.add(wood,
            placed(numbered(tube(stem, std::vector<float>(stem.size(), 0.035f), 8), look.number + 4), at));
}

void add_inside(SceneAssembler& scene, int wood, const Eigen::Affine3f& at, const BoatLook& look) {
  for (int i = 0; i < look.thwarts; ++i) {
    const float s = -0.62f + 1.1f * static_cast<float>(i) / static_cast<float>(std::max(1, look.thwarts - 1));
    const float width = 1.9f * half_breadth(look, s) - 0.03f;
    const Mesh board = numbered(bevelled_box({width, 0.24f, 0.035f}, 0.006f), look.number + 10 + i);
    scene.add(wood, placed(placed(board, Vec3(0, s * look.length_m / 2, look.side_m * 0.62f)), at));
  }
  for (int i = -2; i <= 2; ++i) {
    const Mesh board =
        numbered(bevelled_box({0.13f, look.length_m * 0.72f, 0.02f}, 0.004f), look.number + 20 + i);
    scene.add(wood, placed(placed(board, Vec3(0.145f * static_cast<float>(i), -0.1f, 0.04f)), at));
  }
  for (const float side : {-1.f, 1.f}) {
    const Vec3 grip(side * 0.1f, -0.35f, look.side_m * 0.62f + 0.06f),
        blade(side * 0.3f, 1.5f, look.side_m * 0.62f + 0.1f);
    scene.add(wood, placed(numbered(rod(grip, blade, 0.022f, 0.018f, 8), look.number + 31), at));
    scene.add(wood, placed(placed(numbered(bevelled_box({0.13f, 0.45f, 0.014f}, 0.004f), look.number + 32),
                                  Vec3(blade + Vec3(0, 0.15f, 0))),
                           at));
  }
}

}  // namespace

void add_boat(SceneAssembler& scene, int paint, int wood, const Eigen::Affine3f& at, const BoatLook& look) {
  const auto side = [&](float inset) {
    return [&look, inset](float u, float v) {
      return shell(look, -1 + 2 * std::min(v, 0.9995f), 2 * u - 1, inset);
    };
  };
  const float girth = look.beam_m + look.side_m;
  scene.add(paint, placed(numbered(surface(48, 40, side(0), {girth, look.length_m}), look.number), at));
  scene.add(wood,
            placed(numbered(surface(48, 40, side(0.03f), {girth, look.length_m}), look.number + 1), at));
  const auto transom = [&](float u, float v) {
    const Vec3 edge = shell(look, -1, 2 * u - 1, 0);
    const Vec3 middle(0, -look.length_m / 2, edge.z());
    return Vec3(middle + v * (edge - middle));
  };
  scene.add(paint, placed(numbered(surface(32, 1, transom, {girth, 0.3f}), look.number + 2), at));
  add_gunwales(scene, wood, at, look);
  add_inside(scene, wood, at, look);
}

Vec3 boat_bow(const BoatLook& look) {
  return shell(look, 0.97f, 1, 0).cwiseProduct(Vec3(0, 1, 1));
}

Vec3 boat_stern(const BoatLook& look) {
  return {0, -look.length_m / 2, gunwale_height(look, -1)};
}

void add_lantern(SceneAssembler& scene, const LanternMaterials& materials, const Vec3& top_m,
                 float height_m) {
  const auto radius = [&](float share) {
    const float across = 2 * share - 1;
    return height_m * 0.46f * std::sqrt(std::max(0.f, 1 - 0.8f * across * across));
  };
  const auto band = [&](float from, float to) {
    std::vector<std::array<float, 2>> profile;
    for (int i = 0; i <= 4; ++i) {
      const float share = from + (to - from) * static_cast<float>(i) / 4;
      profile.push_back({radius(share), height_m * (share - 1.12f)});
    }
    return placed(lathe(profile, 16), top_m);
  };
  scene.add(materials.belly, band(0.2f, 0.8f));
  scene.add(materials.shoulder, band(0.02f, 0.2f));
  scene.add(materials.shoulder, band(0.8f, 0.98f));
  for (const float end : {-0.005f, 0.985f}) {
    const float r = 0.24f * height_m, z = height_m * (end - 1.12f);
    const std::array<std::array<float, 2>, 4> cap{{{0.001f, z - 0.02f * height_m},
                                                   {r, z - 0.02f * height_m},
                                                   {r, z + 0.05f * height_m},
                                                   {0.001f, z + 0.05f * height_m}}};
    scene.add(materials.cap, placed(lathe(cap, 16), top_m));
  }
  scene.add(materials.cap, rod(top_m, top_m - Vec3(0, 0, 0.12f * height_m), 0.006f, 0.006f, 5));
}

void add_lantern_rope(SceneAssembler& scene, int rope, const std::vector<LanternMaterials>& kinds,
                      const LanternRope& look) {
  const std::vector<Vec3> path = hanging_line(look.from_m, look.to_m, look.sag_m, 24);
  scene.add(rope, tube(path, std::vector<float>(path.size(), 0.009f), 5));
  for (int i = 0; i < look.lanterns; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(look.lanterns);
    const Vec3 point = look.from_m + (look.to_m - look.from_m) * t - Vec3(0, 0, 4 * look.sag_m * t * (1 - t));
    add_lantern(scene, kinds[static_cast<std::size_t>(i) % kinds.size()], point, look.lantern_m);
  }
}

}  // namespace plenolab
