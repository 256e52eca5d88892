#include <algorithm>
#include <cmath>

#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {
namespace {

/// Calls visit(position on the box, face axis, the other two axes) for a grid of the given cuts on each of
/// the six faces and adds the triangles. `cuts_at(axis)` lists the coordinates of the grid lines along an
/// axis.
template <class CutsAt, class Vertex>
void add_box_faces(Mesh& mesh, const Vec3& half, const CutsAt& cuts_at, const Vertex& vertex) {
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
    const float side = face % 2 == 0 ? 1.f : -1.f;
    const std::vector<float> along_a = cuts_at(a), along_b = cuts_at(b);
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    const auto nb = static_cast<std::uint32_t>(along_b.size());
    for (const float ca : along_a) {
      for (const float cb : along_b) {
        Vec3 p;
        p[axis] = side * half[axis];
        p[a] = ca;
        p[b] = cb;
        vertex(p, a, b);
      }
    }
    for (std::uint32_t i = 0; i + 1 < along_a.size(); ++i) {
      for (std::uint32_t j = 0; j + 1 < nb; ++j) {
        const std::uint32_t v00 = first + i * nb + j, v10 = v00 + nb, v01 = v00 + 1, v11 = v10 + 1;
        if (side > 0) {
          mesh.triangles.insert(mesh.triangles.end(), {{v00, v10, v11}, {v00, v11, v01}});
        } else {
          mesh.triangles.insert(mesh.triangles.end(), {{v00, v11, v10}, {v00, v01, v11}});
        }
      }
    }
  }
}

/// u across, v along the longer of the two face axes, so that grain follows the length of the part.
std::array<float, 2> face_uv(const Vec3& p, const Vec3& size, int a, int b) {
  return size[a] > size[b] ? std::array{p[b], p[a]} : std::array{p[a], p[b]};
}

struct RoundedPoint {
  Vec3 position, normal;
};

RoundedPoint round_off(const Vec3& p, const Vec3& half, float radius) {
  const Vec3 inner = half.array() - radius;
  const Vec3 core = p.cwiseMax(-inner).cwiseMin(inner);
  const Vec3 outward = (p - core).normalized();
  return {core + radius * outward, outward};
}

}  // namespace

Mesh bevelled_box(const Vec3& size_m, float bevel_m) {
  const Vec3 half = size_m / 2;
  Mesh mesh;
  const auto cuts = [&](int axis) {
    return std::vector{-half[axis], -half[axis] + bevel_m, half[axis] - bevel_m, half[axis]};
  };
  add_box_faces(mesh, half, cuts, [&](const Vec3& p, int a, int b) {
    const RoundedPoint rounded = round_off(p, half, bevel_m);
    mesh.positions_m.push_back(rounded.position);
    mesh.normals.push_back(rounded.normal);
    mesh.uvs.push_back(face_uv(p, size_m, a, b));
  });
  return mesh;
}

Mesh rough_stone(const Vec3& size_m, float rounding_m, float roughness_m, int cuts, std::uint32_t seed) {
  const Vec3 half = size_m / 2;
  const float coarse = 1.3f / size_m.maxCoeff();
  Mesh mesh;
  const auto grid = [&](int axis) {
    std::vector<float> at{-half[axis]};
    for (int i = 0; i <= cuts; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(cuts);
      at.push_back((half[axis] - rounding_m) * (2 * share - 1));
    }
    at.push_back(half[axis]);
    return at;
  };
  // Displacement depends on the position alone, so that the faces stay joined.
  add_box_faces(mesh, half, grid, [&](const Vec3& p, int a, int b) {
    const RoundedPoint rounded = round_off(p, half, rounding_m);
    const float bulge = fractal_noise(rounded.position * coarse * 2 + Vec3(7.3f, 1.9f, 4.1f), 3, seed);
    mesh.positions_m.push_back(rounded.position +
                               rounded.normal * (roughness_m * std::clamp(bulge, -1.f, 1.f)));
    mesh.uvs.push_back(face_uv(p, size_m, a, b));
    mesh.normals.push_back(rounded.normal);
  });
  const std::vector<Vec3> rounded_normals = mesh.normals;
  smooth_normals(mesh);
  // Vertices on the edges between faces are separate: their rounded normals hide the seam.
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const bool on_seam = (rounded_normals[i].array().abs() > 0.01f).count() > 1;
    if (on_seam) mesh.normals[i] = rounded_normals[i];
  }
  return mesh;
}

}  // namespace plenolab
