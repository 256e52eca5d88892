#include "stimuli/direct/direct_view.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "stimuli/tracer/ray_scene.h"

namespace plenolab {

struct DirectScene::State {
  explicit State(const Scene& s) : scene(s), rays(scene) {}
  Scene scene;
  tracer::RayScene rays;
};

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A camera of the grid in world coordinates.
struct Camera {
  Vec3 position, right, down, forward;
  double focal_px;
};

Camera camera_at(const GridCamera& c, const ViewGrid& grid, CameraPosition at) {
  const Vec3 right = c.forward.cross(c.up);
  const auto x = static_cast<float>((at.s - (grid.columns - 1) / 2.0) * grid.spacing_x_m);
  const auto y = static_cast<float>((at.t - (grid.rows - 1) / 2.0) * grid.spacing_y_m);
  return {c.centre_m + x * right - y * c.up, right, -c.up, c.forward,
          grid.width / (2.0 * std::tan(grid.fov_h_deg * std::numbers::pi / 360.0))};
}

tracer::Ray camera_ray(const Camera& camera, const ViewGrid& grid, int x, int y) {
  const auto a = static_cast<float>((x + 0.5 - grid.width / 2.0) / camera.focal_px);
  const auto b = static_cast<float>((y + 0.5 - grid.height / 2.0) / camera.focal_px);
  return {camera.position, (camera.forward + a * camera.right + b * camera.down).normalized()};
}

Rgb blended_sky(const Sky& sky, float up) {
  const float t = 0.5f + 0.5f * up;
  return sky.zenith_cd_m2 * t + sky.ground_cd_m2 * (1 - t);
}

/// Radiance of a diffuse surface.
Rgb shade(const DirectScene::State& state, const tracer::Hit& hit) {
  const Material& material = *hit.material;
  if (material.kind == Material::Kind::kEmitter) return material.radiance_cd_m2;
  const Vec3 normal = material.normal ? material.normal(hit.point) : hit.point.normal;
  Rgb irradiance = blended_sky(state.scene.sky, normal.z()) * kPi;
  if (state.scene.sun) {
    const Vec3& to_sun = state.scene.sun->direction;
    const float cosine = normal.dot(to_sun);
    if (cosine > 0 && hit.geometric_normal.dot(to_sun) > 0 &&
        !state.rays.occluded(
            {tracer::offset_origin(hit.point.position_m, hit.geometric_normal, to_sun), to_sun},
            std::numeric_limits<float>::infinity()))
      irradiance += state.scene.sun->illuminance_lx * cosine;
  }
  const Rgb albedo = material.albedo ? material.albedo(hit.point) : Rgb{0.5f, 0.5f, 0.5f};
  return albedo * irradiance * (1 / kPi);
}

/// One row of a view.
void render_row(const DirectScene::State& state, const Camera& camera, const ViewGrid& grid, int y,
                Rgb* radiance, float* depth_m) {
  for (int x = 0; x < grid.width; ++x) {
    const tracer::Ray ray = camera_ray(camera, grid, x, y);
    tracer::Hit hit;
    if (state.rays.intersect(ray, hit)) {
      radiance[x] = shade(state, hit);
      depth_m[x] = hit.distance_m * ray.direction.dot(camera.forward);
    } else {
      radiance[x] = ray.direction.z() >= 0 ? state.scene.sky.zenith_cd_m2 : state.scene.sky.ground_cd_m2;
      depth_m[x] = std::numeric_limits<float>::infinity();
    }
  }
}

}  // namespace

DirectScene::DirectScene(const Scene& scene) {
  validate(scene);
  state_ = std::make_shared<const State>(scene);
}

const Scene& DirectScene::scene() const {
  return state_->scene;
}

DirectView render_direct(const DirectScene& scene, const ViewGrid& grid, CameraPosition position,
                         int threads) {
  grid.validate();
  const Camera camera = camera_at(scene.scene().camera, grid, position);
  DirectView view{SceneImage(grid.width, grid.height), Plane<float>(grid.width, grid.height)};
  parallel_for(grid.height, 8, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      render_row(scene.state(), camera, grid, y, view.radiance.row(y), view.depth_m.row(y));
  });
  return view;
}

DirectView render_direct_views(const DirectScene& scene, const ViewGrid& grid, int threads) {
  grid.validate();
  const int width = grid.columns * grid.width, height = grid.rows * grid.height;
  DirectView views{SceneImage(width, height), Plane<float>(width, height)};
  parallel_for(grid.columns * grid.rows, 1, threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int column = i % grid.columns, row = i / grid.columns;
      const Camera camera =
          camera_at(scene.scene().camera, grid, {static_cast<double>(column), static_cast<double>(row)});
      for (int y = 0; y < grid.height; ++y)
        render_row(scene.state(), camera, grid, y,
                   views.radiance.row(row * grid.height + y) + column * grid.width,
                   views.depth_m.row(row * grid.height + y) + column * grid.width);
    }
  });
  return views;
}

}  // namespace plenolab
