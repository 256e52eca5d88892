#include "stimuli/tracer/sun_patches.h"

#include <algorithm>
#include <cmath>

#include "stimuli/tracer/sampler.h"

namespace plenolab::tracer {

namespace {

constexpr float kCellSide_m = 0.15f;
constexpr int kMaxCellsPerSide = 128;
constexpr std::uint32_t kProbes = 64;
constexpr double kBlockedShare = 0.02;  // of the density of a cell that lets everything through
constexpr std::uint64_t kProbeSeed = 0x73756e70ull;

int cells_along(const Vec3& edge) {
  return std::clamp(static_cast<int>(std::ceil(edge.norm() / kCellSide_m)), 1, kMaxCellsPerSide);
}

int cell_at(float coordinate, int cells) {
  return std::min(static_cast<int>(coordinate * static_cast<float>(cells)), cells - 1);
}

}  // namespace

SunPatches::SunPatches(const Scene& scene, const RayScene& rays, const SunLight& sun)
    : rays_(rays), sun_(sun) {
  if (!sun.shines()) return;
  for (const SkyPortal& portal : scene.portals) add_cells(portal);
  std::vector<double> weights;
  double total = 0, let_through = 0;
  for (const Cell& cell : cells_) {
    const Opening& o = openings_[cell.opening];
    const double share = share_let_through(cell);
    const double cosine = std::abs(o.normal.dot(sun.centre()));
    weights.push_back(static_cast<double>(o.area) / (o.cells_u * o.cells_v) * cosine *
                      std::max(share, kBlockedShare));
    total += weights.back();
    let_through += share;
  }
  if (!(let_through > 0 && total > 0)) {
    cells_.clear();
    return;
  }
  double passed = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Opening& o = openings_[cells_[i].opening];
    cells_[i].density_per_m2 = static_cast<float>(weights[i] / total * (o.cells_u * o.cells_v)) / o.area;
    cumulative_.push_back(static_cast<float>((passed += weights[i]) / total));
  }
}

void SunPatches::add_cells(const SkyPortal& p) {
  const Vec3 cross = p.edge_u_m.cross(p.edge_v_m);
  const float area = cross.norm();
  if (!(area > 0)) return;
  const Vec3 normal = cross / area;
  const Opening opening{p.corner_m,
                        p.edge_u_m,
                        p.edge_v_m,
                        normal,
                        p.edge_v_m.cross(normal) / area,
                        normal.cross(p.edge_u_m) / area,
                        area,
                        cells_along(p.edge_u_m),
                        cells_along(p.edge_v_m),
                        cells_.size()};
  for (int v = 0; v < opening.cells_v; ++v)
    for (int u = 0; u < opening.cells_u; ++u) cells_.push_back({openings_.size(), u, v, 0});
  openings_.push_back(opening);
}

Vec3 SunPatches::point_in(const Cell& cell, std::array<float, 2> u) const {
  const Opening& o = openings_[cell.opening];
  const float a = (static_cast<float>(cell.u) + u[0]) / static_cast<float>(o.cells_u);
  const float b = (static_cast<float>(cell.v) + u[1]) / static_cast<float>(o.cells_v);
  return o.corner + a * o.edge_u + b * o.edge_v;
}

// Whether a point of an opening sees the sun, and what the sun shines on behind it.
bool SunPatches::follow(const Vec3& from, const Vec3& sun_direction, Hit& hit) const {
  return rays_.intersect({from, -sun_direction}, hit) && !rays_.occluded({from, sun_direction});
}

double SunPatches::share_let_through(const Cell& cell) const {
  std::uint32_t passing = 0;
  const auto index = static_cast<std::uint64_t>(&cell - cells_.data());
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    const PathSampler sampler(mix64(kProbeSeed + index), i);
    Hit hit;
    passing += follow(point_in(cell, sampler.get_2d(0)), sun_.sample(sampler.get_2d(1)), hit);
  }
  return static_cast<double>(passing) / kProbes;
}

std::optional<SunPatchPoint> SunPatches::sample(float select, std::array<float, 2> on_opening,
                                                std::array<float, 2> on_disc) const {
  if (cells_.empty()) return std::nullopt;
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), select);
  const auto index =
      std::min<std::size_t>(static_cast<std::size_t>(found - cumulative_.begin()), cells_.size() - 1);
  SunPatchPoint point;
  point.sun_direction = sun_.sample(on_disc);
  if (!follow(point_in(cells_[index], on_opening), point.sun_direction, point.hit)) return std::nullopt;
  point.pdf_area = pdf_area(point.hit.point.position_m, point.hit.geometric_normal, point.sun_direction);
  if (!(point.pdf_area > 0)) return std::nullopt;  // the sun grazes
  return point;
}

float SunPatches::pdf_area(const Vec3& position_m, const Vec3& normal, const Vec3& sun_direction) const {
  if (cells_.empty()) return 0;
  float sum = 0;
  for (const Opening& o : openings_) {
    const float cosine = sun_direction.dot(o.normal);
    if (std::abs(cosine) < 1e-6f) continue;
    const float distance = (o.corner - position_m).dot(o.normal) / cosine;
    if (distance <= 0) continue;
    const Vec3 inside = position_m + distance * sun_direction - o.corner;
    const float u = inside.dot(o.dual_u), v = inside.dot(o.dual_v);
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) continue;
    const auto cell = static_cast<std::size_t>(cell_at(v, o.cells_v) * o.cells_u + cell_at(u, o.cells_u));
    sum += cells_[o.first_cell + cell].density_per_m2 / std::abs(cosine);
  }
  return sum * std::abs(normal.dot(sun_direction));
}

}  // namespace plenolab::tracer
