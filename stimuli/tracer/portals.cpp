#include "stimuli/tracer/portals.h"

#include <algorithm>

namespace plenolab::tracer {

Portals::Portals(const Scene& scene) {
  float total = 0;
  for (const SkyPortal& p : scene.portals) {
    const Vec3 cross = p.edge_u_m.cross(p.edge_v_m);
    const float area = cross.norm();
    if (!(area > 0)) continue;
    const Vec3 normal = cross / area;
    portals_.push_back({p.corner_m, p.edge_u_m, p.edge_v_m, normal, p.edge_v_m.cross(normal) / area,
                        normal.cross(p.edge_u_m) / area, 0});
    cumulative_.push_back(total += area);
  }
  for (Portal& p : portals_) p.probability_per_m2 = 1.0f / total;
  for (float& c : cumulative_) c /= total;
}

DirectionSample Portals::sample(const Vec3& origin, float select, std::array<float, 2> u) const {
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), select);
  const auto index =
      std::min<std::size_t>(static_cast<std::size_t>(found - cumulative_.begin()), portals_.size() - 1);
  const Portal& p = portals_[index];
  const Vec3 towards = p.corner + u[0] * p.edge_u + u[1] * p.edge_v - origin;
  const float distance = towards.norm();
  if (!(distance > 1e-6f)) return {};
  const Vec3 direction = towards / distance;
  return {direction, pdf(origin, direction)};
}

float Portals::pdf(const Vec3& origin, const Vec3& direction) const {
  float sum = 0;
  for (const Portal& p : portals_) {
    const float cosine = direction.dot(p.normal);
    if (std::abs(cosine) < 1e-6f) continue;
    const float distance = (p.corner - origin).dot(p.normal) / cosine;
    if (distance <= 0) continue;
    const Vec3 inside = origin + distance * direction - p.corner;
    const float u = inside.dot(p.dual_u), v = inside.dot(p.dual_v);
    if (u >= 0 && u <= 1 && v >= 0 && v <= 1)
      sum += p.probability_per_m2 * distance * distance / std::abs(cosine);
  }
  return sum;
}

}  // namespace plenolab::tracer
