#include "stimuli/direct/lit_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.h"
#include "stimuli/tracer/ray_scene.h"

namespace plenolab {

struct LitRays::State {
  explicit State(const LitScene& s) : scene(s), rays(scene.scene) {}
  LitScene scene;
  tracer::RayScene rays;
};

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

Rgb ambient_irradiance(const Sky& sky, const Vec3& normal) {
  const float t = 0.5f + 0.5f * normal.z();
  return (sky.zenith_cd_m2 * t + sky.ground_cd_m2 * (1 - t)) * kPi;
}

/// A surface that lamps shine on.
struct Receiver {
  const tracer::RayScene& rays;
  const tracer::Hit& hit;
  Vec3 normal;

  /// Cosine towards a lamp, 0 if it is behind the surface or hidden.
  float cosine(const Vec3& direction, float distance_m) const {
    const float cosine = normal.dot(direction);
    if (cosine <= 0 || hit.geometric_normal.dot(direction) <= 0) return 0;
    const Vec3 from = tracer::offset_origin(hit.point.position_m, hit.geometric_normal, direction);
    return rays.occluded({from, direction}, distance_m) ? 0 : cosine;
  }
};

Rgb lamps_irradiance(const LitScene& scene, const Receiver& receiver) {
  Rgb irradiance{};
  for (const DirectionalLight& light : scene.directions)
    irradiance +=
        light.illuminance_lx * receiver.cosine(light.direction, std::numeric_limits<float>::infinity());
  for (const PointLight& light : scene.points) {
    const Vec3 way = light.position_m - receiver.hit.point.position_m;
    const float distance = way.norm();
    if (distance > 0)
      irradiance += light.intensity_cd * (receiver.cosine(way / distance, distance) / (distance * distance));
  }
  return irradiance;
}

}  // namespace

LitRays::LitRays(const LitScene& scene) {
  validate(scene.scene);
  for (const DirectionalLight& light : scene.directions)
    if (!(std::abs(light.direction.norm() - 1) < 1e-3f))
      throw InputError(
          fmt::format("scene '{}': the direction to a light must be a unit vector", scene.scene.id));
  state_ = std::make_shared<const State>(scene);
}

const LitScene& LitRays::scene() const {
  return state_->scene;
}

Rgb LitRays::radiance(const Vec3& origin_m, const Vec3& direction) const {
  const LitScene& scene = state_->scene;
  tracer::Hit hit;
  if (!state_->rays.intersect({origin_m, direction}, hit))
    return scene.environment ? scene.environment(direction) : Rgb{};
  const Material& material = *hit.material;
  if (material.kind == Material::Kind::kEmitter) return material.radiance_cd_m2;
  const Vec3 normal = material.normal ? material.normal(hit.point) : hit.point.normal;
  const Rgb irradiance =
      ambient_irradiance(scene.scene.sky, normal) + lamps_irradiance(scene, {state_->rays, hit, normal});
  const Rgb albedo = material.albedo ? material.albedo(hit.point) : Rgb{0.5f, 0.5f, 0.5f};
  return albedo * irradiance * (1 / kPi);
}

}  // namespace plenolab
