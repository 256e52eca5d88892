#pragma once

#include <array>
#include <optional>

#include "stimuli/tracer/maths.h"
#include "stimuli/tracer/ray_scene.h"

namespace plenolab::tracer {

/// Reflectance of a smooth dielectric boundary for unpolarised light; `cos_i` ≥ 0 on the incident side, `eta`
/// = index beyond over index before. 1 under total reflection.
float fresnel_dielectric(float cos_i, float eta);

/// A material at one point, its textures evaluated, seen from one direction.
struct Surface {
  const Material* material = nullptr;
  Vec3 position_m;
  Vec3 outgoing;          ///< unit, towards where the ray came from
  Vec3 geometric_normal;  ///< unit, on the side of `outgoing`
  Vec3 normal;  ///< unit shading normal; the mirror direction about it lies above the geometric surface
  bool front = true;
  Rgb albedo;
  float alpha = 0;  ///< GGX roughness

  /// Ideal reflection and refraction: no light can be sampled towards it.
  bool specular() const {
    return material->kind == Material::Kind::kMirror || material->kind == Material::Kind::kDielectric;
  }
};

/// Evaluates the textures. Throws InputError if one returns a value that is not finite or out of the range
/// stated in scene.h.
Surface make_surface(const Hit& hit, const Vec3& ray_direction);

struct BsdfValue {
  Rgb f_cos;      ///< BSDF times |cos| between the incoming direction and the shading normal
  float pdf = 0;  ///< density per solid angle with which sample_bsdf finds the direction
};

/// For surfaces that are not specular. 0 for directions below the surface.
BsdfValue evaluate_bsdf(const Surface& surface, const Vec3& incoming);

struct BsdfSample {
  Vec3 incoming;
  Rgb weight;     ///< f·|cos| / pdf
  float pdf = 0;  ///< per solid angle; meaningless for specular surfaces
  bool transmitted = false;
};

/// Draws a direction. Empty if the drawn one carries nothing. Radiance refracted into a denser medium is
/// scaled by the squared index ratio (Veach 1997, section 5.2).
std::optional<BsdfSample> sample_bsdf(const Surface& surface, float lobe, std::array<float, 2> u);

}  // namespace plenolab::tracer
