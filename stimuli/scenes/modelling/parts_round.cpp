#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {
namespace {

constexpr float kTurn = 2 * static_cast<float>(EIGEN_PI);

std::array<std::uint32_t, 2> ring(std::uint32_t first, int sides, int index) {
  const auto start = first + static_cast<std::uint32_t>(index * (sides + 1));
  return {start, start + static_cast<std::uint32_t>(sides + 1)};
}

void join_rings(Mesh& mesh, std::uint32_t first, int sides, int rings) {
  for (int i = 0; i + 1 < rings; ++i) {
    const auto [low, high] = ring(first, sides, i);
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(sides); ++k) {
      mesh.triangles.push_back({low + k, low + k + 1, high + k + 1});
      mesh.triangles.push_back({low + k, high + k + 1, high + k});
    }
  }
}

void add_cap(Mesh& mesh, const Vec3& centre, const Vec3& normal, const Vec3& x, const Vec3& y, float radius,
             int sides) {
  const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
  for (int k = 0; k <= sides; ++k) {
    const float angle = kTurn * static_cast<float>(k) / static_cast<float>(sides);
    const float a = k == sides ? 0 : radius * std::cos(angle), b = k == sides ? 0 : radius * std::sin(angle);
    mesh.positions_m.push_back(centre + a * x + b * y);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back({a, b});
  }
  const auto middle = first + static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(sides); ++k) {
    const std::uint32_t next = first + (k + 1) % static_cast<std::uint32_t>(sides);
    if (normal.dot(x.cross(y)) > 0) {
      mesh.triangles.push_back({middle, first + k, next});
    } else {
      mesh.triangles.push_back({middle, next, first + k});
    }
  }
}

Vec3 any_orthogonal(const Vec3& direction) {
  const Vec3 helper = std::abs(direction.z()) < 0.9f ? Vec3::UnitZ() : Vec3::UnitX();
  return direction.cross(helper).normalized();
}

Vec3 tangent_at(std::span<const Vec3> path, std::size_t i) {
  const Vec3& before = path[i > 0 ? i - 1 : 0];
  const Vec3& after = path[std::min(i + 1, path.size() - 1)];
  const Vec3 tangent = after - before;
  return tangent.squaredNorm() > 0 ? Vec3(tangent.normalized()) : Vec3(Vec3::UnitZ());
}

/// Local axes of each point of a path, carried along without twist (parallel transport).
struct Frame {
  Vec3 tangent, x, y;
  float along = 0;
};

std::vector<Frame> frames_along(std::span<const Vec3> path) {
  std::vector<Frame> frames(path.size());
  Vec3 x = any_orthogonal(tangent_at(path, 0));
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 tangent = tangent_at(path, i);
    const Vec3 carried = x - tangent * x.dot(tangent);
    x = carried.squaredNorm() > 1e-8f ? Vec3(carried.normalized()) : any_orthogonal(tangent);
    const float along = i > 0 ? frames[i - 1].along + (path[i] - path[i - 1]).norm() : 0;
    frames[i] = {tangent, x, tangent.cross(x), along};
  }
  return frames;
}

void add_ring(Mesh& mesh, const Vec3& centre, const Frame& frame, float radius, float uv_radius, int sides) {
  for (int k = 0; k <= sides; ++k) {
    const float angle = kTurn * static_cast<float>(k) / static_cast<float>(sides);
    const Vec3 outward = std::cos(angle) * frame.x + std::sin(angle) * frame.y;
    mesh.positions_m.push_back(centre + radius * outward);
    mesh.normals.push_back(outward);
    mesh.uvs.push_back({angle * uv_radius, frame.along});
  }
}

}  // namespace

Mesh tube(std::span<const Vec3> path_m, std::span<const float> radii_m, int sides) {
  PLENOLAB_CHECK(path_m.size() >= 2 && path_m.size() == radii_m.size() && sides >= 3,
                 "a tube needs 2 points");
  Mesh mesh;
  const std::vector<Frame> frames = frames_along(path_m);
  for (std::size_t i = 0; i < path_m.size(); ++i) {
    add_ring(mesh, path_m[i], frames[i], radii_m[i], radii_m[0], sides);
  }
  join_rings(mesh, 0, sides, static_cast<int>(path_m.size()));
  const Frame &start = frames.front(), &end = frames.back();
  add_cap(mesh, path_m.front(), -start.tangent, start.x, start.y, radii_m.front(), sides);
  add_cap(mesh, path_m.back(), end.tangent, end.x, end.y, radii_m.back(), sides);
  return mesh;
}

Mesh rod(const Vec3& from_m, const Vec3& to_m, float radius_from_m, float radius_to_m, int sides) {
  return tube(std::array{from_m, to_m}, std::array{radius_from_m, radius_to_m}, sides);
}

Mesh surface(int nu, int nv, const Surface& position, std::array<float, 2> uv_scale) {
  Mesh mesh;
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(nu),
                  v = static_cast<float>(j) / static_cast<float>(nv);
      mesh.positions_m.push_back(position(u, v));
      mesh.uvs.push_back({u * uv_scale[0], v * uv_scale[1]});
    }
  }
  join_rings(mesh, 0, nu, nv + 1);
  smooth_normals(mesh);
  return mesh;
}

Mesh lathe(std::span<const std::array<float, 2>> profile_m, int segments) {
  PLENOLAB_CHECK(profile_m.size() >= 2 && segments >= 3, "a lathe needs a profile of 2 points");
  const auto last = static_cast<float>(profile_m.size() - 1);
  const float widest = (*std::max_element(profile_m.begin(), profile_m.end()))[0];
  const float height = profile_m.back()[1] - profile_m.front()[1];
  const auto position = [&](float u, float v) {
    const auto& [radius, z] = profile_m[static_cast<std::size_t>(std::lround(v * last))];
    const float angle = kTurn * u;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  Mesh mesh = surface(segments, static_cast<int>(profile_m.size()) - 1, position, {kTurn * widest, height});
  // The first and last vertex of a ring are the same point: share their normal.
  for (std::size_t j = 0; j < profile_m.size(); ++j) {
    Vec3& start = mesh.normals[j * static_cast<std::size_t>(segments + 1)];
    Vec3& end = mesh.normals[j * static_cast<std::size_t>(segments + 1) + static_cast<std::size_t>(segments)];
    const Vec3 sum = start + end;
    start = end = sum.squaredNorm() > 1e-8f ? Vec3(sum.normalized()) : start;
  }
  return mesh;
}

Mesh ellipsoid(const Vec3& half_axes_m, int segments) {
  const auto position = [&](float u, float v) {
    const float longitude = kTurn * u, latitude = kTurn / 2 * (v - 0.5f);
    const Vec3 unit(std::cos(longitude) * std::cos(latitude), std::sin(longitude) * std::cos(latitude),
                    std::sin(latitude));
    return Vec3(unit.cwiseProduct(half_axes_m));
  };
  Mesh mesh = surface(segments, std::max(2, segments / 2), position);
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    const Vec3 outward = mesh.positions_m[i].cwiseQuotient(half_axes_m.cwiseProduct(half_axes_m));
    mesh.normals[i] = outward.normalized();
  }
  return mesh;
}

std::vector<Vec3> hanging_line(const Vec3& from_m, const Vec3& to_m, float sag_m, int pieces) {
  std::vector<Vec3> points;
  for (int i = 0; i <= pieces; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(pieces);
    points.push_back(from_m + (to_m - from_m) * t - Vec3(0, 0, 4 * sag_m * t * (1 - t)));
  }
  return points;
}

Mesh leaf(float width, float fold, float curl) {
  // Half outline: share of the width at three stations from stalk to tip.
  constexpr std::array<std::array<float, 2>, 3> kStations{{{0.f, 0.04f}, {0.38f, 0.5f}, {0.75f, 0.32f}}};
  Mesh mesh;
  for (const auto& [along, half] : kStations) {
    const float droop = -curl * along * along;
    for (const float side : {-1.f, 0.f, 1.f}) {
      mesh.positions_m.push_back({side * half * width, along, droop + std::abs(side) * fold * half});
      mesh.uvs.push_back({side * half, along});
    }
  }
  mesh.positions_m.push_back({0, 1, -curl});
  mesh.uvs.push_back({0, 1});
  for (std::uint32_t row = 0; row < 2; ++row) {
    for (std::uint32_t k = row * 3; k < row * 3 + 2; ++k) {
      mesh.triangles.insert(mesh.triangles.end(), {{k, k + 1, k + 4}, {k, k + 4, k + 3}});
    }
  }
  mesh.triangles.insert(mesh.triangles.end(), {{6, 7, 9}, {7, 8, 9}});
  smooth_normals(mesh);
  return mesh;
}

}  // namespace plenolab
