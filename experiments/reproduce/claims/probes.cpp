#include "experiments/reproduce/claims/probes.h"

#include <cmath>

#include "core/base/content_hash.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

Scene empty_probe(const std::string& id, float sky_cd_m2, float fov_h_deg) {
  Scene scene;
  scene.id = id;
  scene.title = id;
  scene.description = "a probe of one claim";
  scene.sky.kind = Sky::Kind::kUniform;
  const Rgb light{sky_cd_m2, sky_cd_m2, sky_cd_m2};
  scene.sky.zenith_cd_m2 = scene.sky.horizon_cd_m2 = scene.sky.ground_cd_m2 = light;
  scene.camera.fov_h_deg = fov_h_deg;
  return scene;
}

void add_surface(Scene& scene, Material material, const Mesh& mesh) {
  scene.materials.push_back(std::move(material));
  scene.meshes.push_back(mesh);
  scene.meshes.back().material = static_cast<int>(scene.materials.size()) - 1;
}

Mesh parallelogram(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v) {
  Mesh mesh;
  mesh.positions_m = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.normals.assign(4, edge_u.cross(edge_v).normalized());
  const float u = edge_u.norm(), v = edge_v.norm();
  mesh.uvs = {{0, 0}, {u, 0}, {u, v}, {0, v}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh card(const Vec3& centre, float width, float height) {
  // x × z = −y: towards the camera.
  return parallelogram(centre - Vec3{width / 2, 0, height / 2}, Vec3{width, 0, 0}, Vec3{0, 0, height});
}

Mesh block(const Vec3& centre, const Vec3& size) {
  const Vec3 x{size.x(), 0, 0}, y{0, size.y(), 0}, z{0, 0, size.z()};
  const Vec3 low = centre - size / 2, high = centre + size / 2;
  Mesh mesh = parallelogram(low, x, z);       // −y
  append(mesh, parallelogram(low, y, x));     // −z
  append(mesh, parallelogram(low, z, y));     // −x
  append(mesh, parallelogram(high, -z, -x));  // +y
  append(mesh, parallelogram(high, -x, -y));  // +z
  append(mesh, parallelogram(high, -y, -z));  // +x
  return mesh;
}

namespace {

constexpr std::size_t kTexturePoints = 512;

void add(ContentHash& hash, const Vec3& v) {
  for (int i = 0; i < 3; ++i) hash.add(static_cast<double>(v[i]));
}
void add(ContentHash& hash, Rgb c) {
  for (const float v : {c.r, c.g, c.b}) hash.add(static_cast<double>(v));
}

/// Looks the textures of a material up at points spread over a mesh.
void add_textures(ContentHash& hash, const Material& material, const Mesh& mesh) {
  const std::size_t triangles = mesh.triangles.size();
  if (triangles == 0) return;
  for (std::size_t i = 0; i < kTexturePoints; ++i) {
    const auto& t = mesh.triangles[i % triangles];
    // Barycentric coordinates of an additive sequence (golden ratio and square root of 2, fractional parts).
    float a = static_cast<float>(std::fmod(0.6180339887 * static_cast<double>(i + 1), 1.0));
    float b = static_cast<float>(std::fmod(0.4142135624 * static_cast<double>(i + 1), 1.0));
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const auto blend = [&](const std::vector<Vec3>& v) -> Vec3 {
      return v[t[0]] * (1 - a - b) + v[t[1]] * a + v[t[2]] * b;
    };
    SurfacePoint point;
    point.position_m = blend(mesh.positions_m);
    point.normal = mesh.normals.empty() ? Vec3::UnitZ() : Vec3(blend(mesh.normals).normalized());
    if (!mesh.uvs.empty()) {
      const auto at = [&](std::size_t axis) {
        return mesh.uvs[t[0]][axis] * (1 - a - b) + mesh.uvs[t[1]][axis] * a + mesh.uvs[t[2]][axis] * b;
      };
      point.u = at(0), point.v = at(1);
    }
    if (material.albedo) add(hash, material.albedo(point));
    if (material.roughness) hash.add(static_cast<double>(material.roughness(point)));
    if (material.normal) add(hash, material.normal(point));
  }
}

void add_mesh(ContentHash& hash, const Mesh& mesh) {
  hash.add(static_cast<double>(mesh.positions_m.size()));
  for (const Vec3& p : mesh.positions_m) add(hash, p);
  for (const Vec3& n : mesh.normals) add(hash, n);
  for (const auto& uv : mesh.uvs) hash.add(static_cast<double>(uv[0])), hash.add(static_cast<double>(uv[1]));
  hash.add(static_cast<double>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t) hash.add(static_cast<double>(corner));
}

void add_material(ContentHash& hash, const Material& m) {
  hash.add(static_cast<double>(m.kind));
  for (const bool given : {static_cast<bool>(m.albedo), static_cast<bool>(m.roughness),
                           static_cast<bool>(m.normal), m.two_sided})
    hash.add(given ? 1.0 : 0.0);
  hash.add(static_cast<double>(m.ior));
  add(hash, m.absorption_per_m);
  add(hash, m.radiance_cd_m2);
}

void add_light(ContentHash& hash, const Scene& scene) {
  hash.add(scene.sun ? "sun" : "no sun");
  if (scene.sun) {
    add(hash, scene.sun->direction);
    hash.add(static_cast<double>(scene.sun->angular_diameter_deg));
    add(hash, scene.sun->illuminance_lx);
  }
  hash.add(static_cast<double>(scene.sky.kind));
  for (const Rgb c : {scene.sky.zenith_cd_m2, scene.sky.horizon_cd_m2, scene.sky.ground_cd_m2}) add(hash, c);
  hash.add(static_cast<double>(scene.sky.turbidity));
  for (const SkyPortal& portal : scene.portals)
    for (const Vec3& v : {portal.corner_m, portal.edge_u_m, portal.edge_v_m}) add(hash, v);
  hash.add(scene.medium ? "medium" : "no medium");
  if (scene.medium) {
    add(hash, scene.medium->min_m);
    add(hash, scene.medium->max_m);
    for (const float v :
         {scene.medium->scattering_per_m, scene.medium->absorption_per_m, scene.medium->anisotropy})
      hash.add(static_cast<double>(v));
  }
}

}  // namespace

void seal(Scene& scene) {
  ContentHash hash;
  for (const Vec3& v : {scene.camera.centre_m, scene.camera.forward, scene.camera.up}) add(hash, v);
  hash.add(static_cast<double>(scene.camera.fov_h_deg));
  hash.add(static_cast<double>(scene.max_bounces));
  hash.add(scene.caustics ? 1.0 : 0.0);
  add_light(hash, scene);
  for (const Mesh& mesh : scene.meshes) {
    add_mesh(hash, mesh);
    const Material& material = scene.materials.at(static_cast<std::size_t>(mesh.material));
    add_material(hash, material);
    add_textures(hash, material, mesh);
  }
  scene.variant = hash.hex();
}

}  // namespace plenolab
