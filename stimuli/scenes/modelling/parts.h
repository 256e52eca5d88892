#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <span>

#include "stimuli/scene.h"

namespace plenolab {

/// Mesh parts: every builder returns positions, unit normals and uvs for each vertex, uv in metres unless
/// said otherwise. Parts are placed with `placed`, told apart in textures with `numbered` and collected by
/// SceneAssembler.

/// Turn about the vertical axis by `yaw_deg` (counter-clockwise from above), then move.
Eigen::Affine3f pose(const Vec3& offset_m, float yaw_deg = 0);

/// Copy of a part under a rigid or scaling transform (normals by the inverse transpose).
Mesh placed(const Mesh& part, const Eigen::Affine3f& transform);
/// Copy moved by `offset_m`.
Mesh placed(const Mesh& part, const Vec3& offset_m);

/// Offset of u between parts of different number; parts are narrower than half of it.
inline constexpr float kPartPitch = 16;
inline constexpr int kPartNumbers = 256;
/// Copy whose u carries a number (taken modulo 256) that part_of reads back in textures.
Mesh numbered(const Mesh& part, int number);
/// Number of the part a surface point lies on, and its u and v within the part.
struct PartPoint {
  int number = 0;
  float u = 0, v = 0;
};
PartPoint part_of(const SurfacePoint& point);

/// Appends triangles and vertices of `part`.
void append(Mesh& to, const Mesh& part);
/// Area-weighted vertex normals from the triangles.
void smooth_normals(Mesh& mesh);

/// Box centred at the origin with edges of the bevel's width, v along its longest side, u across. Bevel > 0
/// and less than half of the shortest side. 108 triangles.
Mesh bevelled_box(const Vec3& size_m, float bevel_m);

/// Box with rounded edges whose surface is pushed about by noise: dressed stone, flagstones, rubble. `cuts` ≥
/// 2 subdivisions a side, `roughness_m` the largest displacement.
Mesh rough_stone(const Vec3& size_m, float rounding_m, float roughness_m, int cuts, std::uint32_t seed);

/// Surface (u, v) in [0, 1]² → position with nu × nv cells, smooth normals on the side of ∂u × ∂v; uv are the
/// parameters scaled by `uv_scale`.
using Surface = std::function<Vec3(float u, float v)>;
Mesh surface(int nu, int nv, const Surface& position, std::array<float, 2> uv_scale = {1, 1});

/// Tube along a polyline of ≥ 2 points, one radius per point; u around in metres, v along. Open ends are
/// closed by flat caps.
Mesh tube(std::span<const Vec3> path_m, std::span<const float> radii_m, int sides);
/// Straight tube with one radius at each end.
Mesh rod(const Vec3& from_m, const Vec3& to_m, float radius_from_m, float radius_to_m, int sides);

/// Surface of revolution about z of a profile (radius, height), v along the profile, u around in metres.
Mesh lathe(std::span<const std::array<float, 2>> profile_m, int segments);
/// Ellipsoid with half axes, centred at the origin; u, v are longitude and latitude in [0, 1].
Mesh ellipsoid(const Vec3& half_axes_m, int segments);

/// Rope between two points that sags by `sag_m` in its middle (parabola), `pieces` + 1 points.
std::vector<Vec3> hanging_line(const Vec3& from_m, const Vec3& to_m, float sag_m, int pieces);

/// Pointed leaf of length 1 along +y, folded along its midrib, facing +z; u across [−½, ½], v along [0, 1].
/// `width` as share of the length, `fold` the height of its rim, `curl` the drop of its tip. 10 triangles.
Mesh leaf(float width, float fold, float curl);

}  // namespace plenolab
