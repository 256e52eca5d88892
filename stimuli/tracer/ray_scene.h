#pragma once

#include <limits>
#include <memory>

#include "stimuli/scene.h"

namespace plenolab::tracer {

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit
};

/// The first surface along a ray.
struct Hit {
  float distance_m = 0;
  SurfacePoint point;     ///< the interpolated normal is on the side the ray came from
  Vec3 geometric_normal;  ///< unit, of the triangle, on the side the ray came from
  bool front = true;      ///< met on the side from which the corners run counter-clockwise
  const Material* material = nullptr;
};

/// The triangles of a scene behind an Embree acceleration structure. The scene must outlive it. Triangles
/// without area are never hit. Thread-safe; built on one thread, so that the tree, and with it every hit, is
/// always the same.
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// False if the ray leaves the scene.
  bool intersect(const Ray& ray, Hit& hit) const;
  /// Distance to the first surface only; ∞ if there is none. What an ideal tracer would cost (benchmarks).
  float distance(const Ray& ray) const;
  /// Whether anything lies between the origin and `distance_m`.
  bool occluded(const Ray& ray, float distance_m = std::numeric_limits<float>::infinity()) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A point just off a surface, on the side `direction` goes to, from which a new ray does not meet the same
/// surface.
Vec3 offset_origin(const Vec3& position_m, const Vec3& geometric_normal, const Vec3& direction);

}  // namespace plenolab::tracer
