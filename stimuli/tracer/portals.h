#pragma once

#include <array>
#include <vector>

#include "stimuli/tracer/sky_light.h"

namespace plenolab::tracer {

/// Openings of an interior: directions to the sky are drawn through them, uniformly over their area. Combined
/// with sampling by the BSDF this stays unbiased, also for sky that is seen past every portal.
class Portals {
 public:
  explicit Portals(const Scene& scene);

  bool empty() const { return portals_.empty(); }
  /// A direction from `origin` through a portal, with the density of all portals it crosses; pdf 0 if it
  /// grazes.
  DirectionSample sample(const Vec3& origin, float select, std::array<float, 2> u) const;
  float pdf(const Vec3& origin, const Vec3& direction) const;

 private:
  struct Portal {
    Vec3 corner, edge_u, edge_v, normal;
    Vec3 dual_u, dual_v;  ///< (p − corner)·dual gives the coordinates in the parallelogram
    float probability_per_m2;
  };
  std::vector<Portal> portals_;
  std::vector<float> cumulative_;
};

}  // namespace plenolab::tracer
