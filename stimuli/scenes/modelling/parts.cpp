#include "stimuli/scenes/modelling/parts.h"

#include <cmath>

namespace plenolab {

Eigen::Affine3f pose(const Vec3& offset_m, float yaw_deg) {
  const float angle = yaw_deg * static_cast<float>(EIGEN_PI) / 180;
  return Eigen::Translation3f(offset_m) * Eigen::AngleAxisf(angle, Vec3::UnitZ()) *
         Eigen::Affine3f::Identity();
}

Mesh placed(const Mesh& part, const Eigen::Affine3f& transform) {
  Mesh result = part;
  const Eigen::Matrix3f linear = transform.linear();
  const Eigen::Matrix3f for_normals = linear.inverse().transpose();
  for (Vec3& p : result.positions_m) p = transform * p;
  for (Vec3& n : result.normals) n = (for_normals * n).normalized();
  if (linear.determinant() < 0) {
    for (auto& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
  }
  return result;
}

Mesh placed(const Mesh& part, const Vec3& offset_m) {
  Mesh result = part;
  for (Vec3& p : result.positions_m) p += offset_m;
  return result;
}

Mesh numbered(const Mesh& part, int number) {
  Mesh result = part;
  const int wrapped = (number % kPartNumbers + kPartNumbers) % kPartNumbers;
  for (auto& uv : result.uvs) uv[0] += kPartPitch * static_cast<float>(wrapped);
  return result;
}

PartPoint part_of(const SurfacePoint& point) {
  const float number = std::floor(point.u / kPartPitch + 0.5f);
  return {static_cast<int>(number), point.u - kPartPitch * number, point.v};
}

void append(Mesh& to, const Mesh& part) {
  const auto first = static_cast<std::uint32_t>(to.positions_m.size());
  to.positions_m.insert(to.positions_m.end(), part.positions_m.begin(), part.positions_m.end());
  to.normals.insert(to.normals.end(), part.normals.begin(), part.normals.end());
  to.uvs.insert(to.uvs.end(), part.uvs.begin(), part.uvs.end());
  for (const auto& t : part.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

void smooth_normals(Mesh& mesh) {
  mesh.normals.assign(mesh.positions_m.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
    const Vec3 area = (b - a).cross(c - a);
    for (const std::uint32_t corner : t) mesh.normals[corner] += area;
  }
  for (Vec3& n : mesh.normals) n = n.squaredNorm() > 0 ? Vec3(n.normalized()) : Vec3(Vec3::UnitZ());
}

}  // namespace plenolab
