#include "stimuli/direct/lit_view.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "stimuli/tracer/ray_scene.h"

namespace plenolab {

struct LitViews::State {
  explicit State(const LitScene& scene) : light(scene), rays(light.scene().scene) {}
  LitRays light;
  tracer::RayScene rays;
};

namespace {

constexpr int kRowGrain = 4;

/// Direction of the ray through a pixel's centre, its component along `forward` being 1.
Vec3 ray_of(const LitCamera& camera, int x, int y, int width, int height) {
  const float pixel =
      2 * std::tan(camera.fov_h_deg * std::numbers::pi_v<float> / 360) / static_cast<float>(width);
  const float across = (static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(width)) * pixel,
              upwards = (0.5f * static_cast<float>(height) - static_cast<float>(y) - 0.5f) * pixel;
  return camera.forward + across * camera.forward.cross(camera.up) + upwards * camera.up;
}

}  // namespace

LitViews::LitViews(const LitScene& scene) : state_(std::make_shared<const State>(scene)) {}

LitView LitViews::render(const LitCamera& camera, int width, int height, int threads) const {
  return trace(camera, width, height, true, threads);
}

LitView LitViews::surfaces(const LitCamera& camera, int width, int height, int threads) const {
  return trace(camera, width, height, false, threads);
}

LitView LitViews::trace(const LitCamera& camera, int width, int height, bool lit, int threads) const {
  const Material* first = state_->light.scene().scene.materials.data();
  LitView view{lit ? SceneImage(width, height) : SceneImage(),
               Plane<float>(width, height, std::numeric_limits<float>::infinity()),
               Plane<int>(width, height, -1)};
  parallel_for(height, kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const Vec3 ray = ray_of(camera, x, y, width, height);
        const float length = ray.norm();
        const Vec3 direction = ray / length;
        if (lit) view.radiance.at(x, y) = state_->light.radiance(camera.position_m, direction);
        tracer::Hit hit;
        if (!state_->rays.intersect({camera.position_m, direction}, hit)) continue;
        view.depth_m.at(x, y) = hit.distance_m / length;
        view.material.at(x, y) = static_cast<int>(hit.material - first);
      }
  });
  return view;
}

}  // namespace plenolab
