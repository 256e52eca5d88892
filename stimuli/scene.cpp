#include "stimuli/scene.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

[[noreturn]] void fail(const Scene& scene, const std::string& what) {
  throw InputError(fmt::format("the scene \"{}\" cannot be rendered: {}", scene.id, what));
}

void require_finite(const Scene& scene, const Vec3& v, const std::string& what) {
  if (!v.allFinite()) fail(scene, fmt::format("{} is ({}, {}, {})", what, v.x(), v.y(), v.z()));
}

void require_unit(const Scene& scene, const Vec3& v, const std::string& what) {
  require_finite(scene, v, what);
  if (std::abs(v.norm() - 1) > 1e-3f)
    fail(scene, fmt::format("{} must be a unit vector, its length is {}", what, v.norm()));
}

void require_at_least_zero(const Scene& scene, Rgb c, const std::string& what) {
  for (const float v : {c.r, c.g, c.b})
    if (!(v >= 0) || !std::isfinite(v)) fail(scene, fmt::format("{} holds {}", what, v));
}

void validate_mesh(const Scene& scene, std::size_t index) {
  const Mesh& mesh = scene.meshes[index];
  const std::string name = fmt::format("mesh {}", index);
  if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= scene.materials.size())
    fail(scene, fmt::format("{} uses material {} of {}", name, mesh.material, scene.materials.size()));
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions_m.size())
    fail(scene, fmt::format("{} has {} normals for {} vertices", name, mesh.normals.size(),
                            mesh.positions_m.size()));
  if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions_m.size())
    fail(scene, fmt::format("{} has {} uvs for {} vertices", name, mesh.uvs.size(), mesh.positions_m.size()));
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= mesh.positions_m.size())
        fail(scene, fmt::format("{} names vertex {} of {}", name, corner, mesh.positions_m.size()));
  for (const Vec3& p : mesh.positions_m) require_finite(scene, p, name + ": a vertex");
  for (const Vec3& n : mesh.normals) require_finite(scene, n, name + ": a normal");
}

void validate_material(const Scene& scene, std::size_t index) {
  const Material& m = scene.materials[index];
  const std::string name = fmt::format("material {}", index);
  const bool uses_ior = m.kind == Material::Kind::kDielectric || m.kind == Material::Kind::kGlossy;
  if (uses_ior && !(m.ior >= 1 && m.ior <= 10))
    fail(scene, fmt::format("{} has the index of refraction {}", name, m.ior));
  require_at_least_zero(scene, m.absorption_per_m, name + ": absorption");
  require_at_least_zero(scene, m.radiance_cd_m2, name + ": radiance");
}

void validate_sky(const Scene& scene) {
  const Sky& sky = scene.sky;
  require_at_least_zero(scene, sky.zenith_cd_m2, "the zenith radiance");
  require_at_least_zero(scene, sky.horizon_cd_m2, "the horizon radiance");
  require_at_least_zero(scene, sky.ground_cd_m2, "the ground radiance");
  if (sky.kind != Sky::Kind::kDaylight) return;
  if (!scene.sun || !(scene.sun->direction.z() > 0))
    fail(scene, "a daylight sky needs a sun above the horizon");
  if (!(sky.turbidity >= 1.7f && sky.turbidity <= 10))
    fail(scene, fmt::format("the daylight model holds for a turbidity in [1.7, 10], not {}", sky.turbidity));
}

void validate_medium(const Scene& scene, const Medium& medium) {
  require_finite(scene, medium.min_m, "a corner of the medium");
  require_finite(scene, medium.max_m, "a corner of the medium");
  if ((medium.max_m.array() < medium.min_m.array()).any()) fail(scene, "the medium's box is inside out");
  require_at_least_zero(scene, {medium.scattering_per_m, medium.absorption_per_m, 0}, "the medium");
  if (!(std::abs(medium.anisotropy) < 1))
    fail(scene, fmt::format("the medium's anisotropy must lie in (-1, 1), not {}", medium.anisotropy));
}

}  // namespace

void validate(const Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) validate_material(scene, i);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) validate_mesh(scene, i);
  if (scene.sun) {
    require_unit(scene, scene.sun->direction, "the sun's direction");
    require_at_least_zero(scene, scene.sun->illuminance_lx, "the sun's illuminance");
    if (!(scene.sun->angular_diameter_deg > 0 && scene.sun->angular_diameter_deg < 90))
      fail(scene, fmt::format("the sun's diameter must lie in (0, 90) degrees, not {}",
                              scene.sun->angular_diameter_deg));
  }
  validate_sky(scene);
  if (scene.medium) validate_medium(scene, *scene.medium);
  for (const SkyPortal& p : scene.portals)
    for (const Vec3& v : {p.corner_m, p.edge_u_m, p.edge_v_m}) require_finite(scene, v, "a portal");
  require_finite(scene, scene.camera.centre_m, "the camera centre");
  require_unit(scene, scene.camera.forward, "the viewing direction");
  require_unit(scene, scene.camera.up, "the up direction");
  if (std::abs(scene.camera.forward.dot(scene.camera.up)) > 1e-3f)
    fail(scene, "up is not orthogonal to forward");
  if (scene.max_bounces < 0) fail(scene, fmt::format("the number of bounces is {}", scene.max_bounces));
}

}  // namespace plenolab
