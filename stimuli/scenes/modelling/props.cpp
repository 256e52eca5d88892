#include "stimuli/scenes/modelling/props.h"

#include <cmath>

#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {
namespace {

constexpr float kTurn = 2 * static_cast<float>(EIGEN_PI);

float barrel_radius(float share, float height) {
  const float bulge = 1 - (2 * share - 1) * (2 * share - 1);
  return height * (0.27f + 0.075f * bulge);
}

Mesh stave(int index, int count, float height) {
  const float middle = kTurn * static_cast<float>(index) / static_cast<float>(count);
  const float half = kTurn / static_cast<float>(count) / 2;
  Mesh mesh = surface(4, 10,
                      [&](float u, float v) {
                        // The seam between staves is a groove.
                        const float across = 2 * u - 1;
                        const float groove = 0.006f * std::pow(std::abs(across), 6.f);
                        const float radius = barrel_radius(v, height) - groove;
                        const float angle = middle + half * across;
                        return Vec3(radius * std::cos(angle), radius * std::sin(angle), v * height);
                      },
                      {kTurn * height * 0.33f / static_cast<float>(count), height});
  return mesh;
}

}  // namespace

void add_barrel(SceneAssembler& scene, int wood, int iron, const Eigen::Affine3f& at, float height_m,
                int number) {
  constexpr int kStaves = 18;
  for (int i = 0; i < kStaves; ++i) {
    scene.add(wood, placed(numbered(stave(i, kStaves, height_m), number + 7 * i), at));
  }
  for (const float end : {0.03f, 0.97f}) {
    const float radius = barrel_radius(end, height_m);
    const auto head = [&](float u, float v) {
      return Vec3(v * radius * std::cos(kTurn * u), v * radius * std::sin(kTurn * u), end * height_m);
    };
    Mesh disc = surface(24, 1, head);
    for (std::size_t i = 0; i < disc.uvs.size(); ++i)
      disc.uvs[i] = {disc.positions_m[i].x(), disc.positions_m[i].y()};
    disc.normals.assign(disc.positions_m.size(), Vec3(0, 0, end > 0.5f ? 1.f : -1.f));
    scene.add(wood, placed(numbered(disc, number + 3), at));
  }
  for (const float share : {0.06f, 0.27f, 0.73f, 0.94f}) {
    const float low = share - 0.022f, high = share + 0.022f, proud = 0.005f;
    const std::array<std::array<float, 2>, 4> band{{{barrel_radius(low, height_m), low * height_m},
                                                    {barrel_radius(low, height_m) + proud, low * height_m},
                                                    {barrel_radius(high, height_m) + proud, high * height_m},
                                                    {barrel_radius(high, height_m), high * height_m}}};
    scene.add(iron, placed(lathe(band, 40), at));
  }
}

void add_crate(SceneAssembler& scene, int wood, const Eigen::Affine3f& at, const Vec3& size_m, int number) {
  constexpr float kBoard = 0.016f, kSlats = 4;
  const auto add = [&](const Vec3& size, const Vec3& centre) {
    scene.add(wood, placed(placed(numbered(bevelled_box(size, 0.002f), number++ * 11), centre), at));
  };
  const float slat = size_m.z() / kSlats;
  for (float i = 0; i < kSlats; ++i) {
    for (const float side : {-1.f, 1.f}) {
      const float z = (i + 0.5f) * slat;
      add({size_m.x(), kBoard, slat * 0.84f}, {0, side * (size_m.y() - kBoard) / 2, z});
      add({kBoard, size_m.y() - 2 * kBoard, slat * 0.84f}, {side * (size_m.x() - kBoard) / 2, 0, z});
    }
  }
  for (const float sx : {-1.f, 1.f}) {
    for (const float sy : {-1.f, 1.f}) {
      add({0.035f, 0.035f, size_m.z()},
          {sx * (size_m.x() / 2 - 0.034f), sy * (size_m.y() / 2 - 0.034f), size_m.z() / 2});
    }
  }
  add({size_m.x() - 2 * kBoard, size_m.y() - 2 * kBoard, kBoard}, {0, 0, kBoard});
}

Mesh bottle(float height_m) {
  const float h = height_m;
  const std::array<std::array<float, 2>, 10> profile{{{0.0f, 0.0f},
                                                      {0.12f * h, 0.0f},
                                                      {0.13f * h, 0.015f * h},
                                                      {0.13f * h, 0.5f * h},
                                                      {0.12f * h, 0.58f * h},
                                                      {0.06f * h, 0.7f * h},
                                                      {0.045f * h, 0.78f * h},
                                                      {0.045f * h, 0.94f * h},
                                                      {0.052f * h, 0.95f * h},
                                                      {0.05f * h, h}}};
  return lathe(profile, 16);
}

Mesh jar(float height_m) {
  const float h = height_m;
  const std::array<std::array<float, 2>, 10> profile{{{0.0f, 0.0f},
                                                      {0.28f * h, 0.0f},
                                                      {0.36f * h, 0.15f * h},
                                                      {0.39f * h, 0.4f * h},
                                                      {0.36f * h, 0.65f * h},
                                                      {0.25f * h, 0.8f * h},
                                                      {0.24f * h, 0.84f * h},
                                                      {0.3f * h, 0.86f * h},
                                                      {0.3f * h, 0.95f * h},
                                                      {0.f, h}}};
  return lathe(profile, 20);
}

Mesh ladder(const Vec3& foot_m, const Vec3& top_m, const Vec3& sideways, float width_m, int number) {
  const Vec3 across = sideways * (width_m / 2);
  Mesh mesh;
  for (const float side : {-1.f, 1.f}) {
    append(mesh, numbered(rod(foot_m + side * across, top_m + side * across, 0.028f, 0.024f, 10), number));
  }
  const int rungs = static_cast<int>((top_m - foot_m).norm() / 0.29f);
  for (int i = 1; i < rungs; ++i) {
    const Vec3 middle = foot_m + (top_m - foot_m) * (static_cast<float>(i) / static_cast<float>(rungs));
    append(mesh, numbered(rod(middle - across, middle + across, 0.016f, 0.016f, 8), number + i));
  }
  return mesh;
}

}  // namespace plenolab
