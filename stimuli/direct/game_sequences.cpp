#include "stimuli/direct/game_sequences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/image/colour.h"
#include "stimuli/direct/games/scenes.h"
#include "stimuli/tracer/ray_scene.h"

namespace plenolab {

struct GameRenderer::State {
  explicit State(const GameScene& s) : scene(s), lit(scene.lit), rays(scene.lit.scene) {}
  GameScene scene;
  LitRays lit;
  tracer::RayScene rays;
};

namespace {

constexpr int kSide = 2;  // rays along each side of a pixel

struct View {
  Vec3 position, forward, right, down;
};

View view_between(const GameCamera& first, const GameCamera& last, float t) {
  const Vec3 position = first.position_m + t * (last.position_m - first.position_m);
  const Vec3 target = first.target_m + t * (last.target_m - first.target_m);
  const Vec3 forward = (target - position).normalized();
  const Vec3 right = forward.cross(Vec3(0, 0, 1)).normalized();
  return {position, forward, right, forward.cross(right)};
}

/// Share of light that a polished surface mirrors (Schlick 1994).
float mirrored_share(const Material& material, float cosine) {
  const float r = (material.ior - 1) / (material.ior + 1);
  return r * r + (1 - r * r) * std::pow(1 - std::clamp(cosine, 0.0f, 1.0f), 5.0f);
}

/// Diffuse light, and what glossy surfaces mirror of the first surface along the mirrored ray.
Rgb shade(const LitRays& lit, const tracer::RayScene& rays, const tracer::Ray& ray) {
  Rgb radiance = lit.radiance(ray.origin, ray.direction);
  tracer::Hit hit;
  if (!rays.intersect(ray, hit) || hit.material->kind != Material::Kind::kGlossy) return radiance;
  const Vec3& normal = hit.point.normal;
  const float cosine = -ray.direction.dot(normal);
  const Vec3 mirrored = (ray.direction + 2 * cosine * normal).normalized();
  if (cosine <= 0 || mirrored.dot(hit.geometric_normal) <= 0) return radiance;
  const Vec3 origin = tracer::offset_origin(hit.point.position_m, hit.geometric_normal, mirrored);
  return radiance + lit.radiance(origin, mirrored) * mirrored_share(*hit.material, cosine);
}

}  // namespace

const char* name_of(GameLight light) {
  switch (light) {
    case GameLight::kDarkHighContrast:
      return "dark, high contrast";
    case GameLight::kDarkLowContrast:
      return "dark, low contrast";
    case GameLight::kBrightHighContrast:
      return "bright, high contrast";
    case GameLight::kBrightLowContrast:
      return "bright, low contrast";
  }
  return "";
}

std::span<const GameSequence> game_sequences() {
  using enum GameLight;
  static constexpr std::array kSequences{
      GameSequence{"after-reflections", "after Reflections", kDarkHighContrast, build_reflections},
      GameSequence{"after-effects-cave-2", "after Effects Cave 2", kDarkHighContrast, build_effects_cave_2},
      GameSequence{"after-effects-cave", "after Effects Cave", kDarkLowContrast, build_effects_cave},
      GameSequence{"after-realistic-reflections", "after Realistic Reflections", kDarkLowContrast,
                   build_realistic_reflections},
      GameSequence{"after-temple", "after Temple", kDarkLowContrast, build_temple},
      GameSequence{"after-realistic-reflections-2", "after Realistic Reflections 2", kDarkLowContrast,
                   build_realistic_reflections_2},
      GameSequence{"after-sun-temple", "after Sun Temple", kBrightHighContrast, build_sun_temple},
      GameSequence{"after-research-lab", "after Research Lab", kBrightHighContrast, build_research_lab},
      GameSequence{"after-vehicle-game", "after Vehicle Game", kBrightLowContrast, build_vehicle_game},
      GameSequence{"after-living-room", "after Living Room", kBrightLowContrast, build_living_room},
  };
  return kSequences;
}

GameRenderer::GameRenderer(const GameScene& scene) : state_(std::make_shared<const State>(scene)) {}

SceneImage GameRenderer::frame(int frame, int width, int height, int threads) const {
  PLENOLAB_CHECK(frame >= 0 && frame < kGameFrames && width > 0 && height > 0, "a frame of the sequence");
  const GameScene& scene = state_->scene;
  const View view =
      view_between(scene.first, scene.last, static_cast<float>(frame) / static_cast<float>(kGameFrames - 1));
  const float focal = static_cast<float>(width) /
                      (2 * std::tan(scene.fov_h_deg * std::numbers::pi_v<float> / 360.0f)) *
                      static_cast<float>(kSide);
  SceneImage image(width, height);
  parallel_for(height, 4, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        Rgb sum{};
        for (int k = 0; k < kSide * kSide; ++k) {
          const float a =
              (static_cast<float>(kSide * x + k % kSide) + 0.5f - static_cast<float>(kSide * width) / 2) /
              focal;
          const float b =
              (static_cast<float>(kSide * y + k / kSide) + 0.5f - static_cast<float>(kSide * height) / 2) /
              focal;
          sum += shade(state_->lit, state_->rays,
                       {view.position, (view.forward + a * view.right + b * view.down).normalized()});
        }
        image.at(x, y) = sum * (1.0f / static_cast<float>(kSide * kSide));
      }
  });
  return image;
}

GameExposure exposure_of(const SceneImage& frame_cd_m2) {
  std::vector<double> logs;
  double sum = 0;
  for (const Rgb& c : frame_cd_m2.pixels())
    if (const float l = luminance(c); l > 0) {
      logs.push_back(std::log10(static_cast<double>(l)));
      sum += logs.back();
    }
  if (logs.empty()) return {};
  std::sort(logs.begin(), logs.end());
  return {std::pow(10.0, sum / static_cast<double>(logs.size())),
          quantile_of_sorted<double>(logs, 0.995) - quantile_of_sorted<double>(logs, 0.005)};
}

}  // namespace plenolab
