#pragma once

#include <cmath>
#include <numbers>

#include "stimuli/render.h"

namespace plenolab::testing {

/// A parallelogram of two triangles; counter-clockwise seen from the side edge_u × edge_v points to.
inline Mesh parallelogram(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v, int material) {
  Mesh mesh;
  mesh.positions_m = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = material;
  return mesh;
}

/// A sphere of `rings` × 2·rings quads. Outward triangles; `smooth` adds the sphere's normals.
inline Mesh sphere(const Vec3& centre, float radius, int rings, int material, bool smooth = false) {
  Mesh mesh;
  mesh.material = material;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * 2 * j / columns;
      const Vec3 n(static_cast<float>(std::sin(theta) * std::cos(phi)),
                   static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta)));
      mesh.positions_m.push_back(centre + radius * n);
      if (smooth) mesh.normals.push_back(n);
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (columns + 1) + j);
      const auto b = a + static_cast<std::uint32_t>(columns) + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

inline ColourTexture constant(Rgb c) {
  return [c](const SurfacePoint&) { return c; };
}
inline ScalarTexture constant(float v) {
  return [v](const SurfacePoint&) { return v; };
}

inline Material diffuse(float albedo) {
  Material m;
  m.albedo = constant(Rgb{albedo, albedo, albedo});
  return m;
}

inline Material lamp(Rgb radiance, bool two_sided = true) {
  Material m;
  m.kind = Material::Kind::kEmitter;
  m.radiance_cd_m2 = radiance;
  m.two_sided = two_sided;
  return m;
}

/// A scene without light and things, camera at the origin looking along +y with 60°.
inline Scene empty_scene() {
  Scene scene;
  scene.id = "test";
  return scene;
}

inline Sky uniform_sky(float radiance, float ground) {
  Sky sky;
  sky.kind = Sky::Kind::kUniform;
  sky.zenith_cd_m2 = {radiance, radiance, radiance};
  sky.ground_cd_m2 = {ground, ground, ground};
  return sky;
}

/// One view of few pixels.
inline ViewGrid small_grid(int width = 8, int height = 8, double fov_h_deg = 60) {
  return {1, 1, 0.1, 0.1, width, height, fov_h_deg};
}

/// Integral over the sphere by a midpoint rule.
template <class F>
inline double integrate_sphere(F f, int rows) {
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 2 * rows; ++j) {
      const double cosine = 1 - 2 * (i + 0.5) / rows, sine = std::sqrt(1 - cosine * cosine);
      const double phi = std::numbers::pi * (j + 0.5) / rows;
      sum += f(Vec3(static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
                    static_cast<float>(cosine)));
    }
  return sum * 4 * std::numbers::pi / (2.0 * rows * rows);
}

/// Mean colour of all pixels, in double.
inline double mean_green(const SceneImage& image) {
  double sum = 0;
  for (const Rgb& c : image.pixels()) sum += c.g;
  return sum / static_cast<double>(image.size());
}

inline RenderedView render(const Scene& scene, const ViewGrid& grid, RenderSettings settings = {},
                           CameraPosition at = {0, 0}) {
  return render_view(PreparedScene(scene), grid, at, settings);
}

}  // namespace plenolab::testing
