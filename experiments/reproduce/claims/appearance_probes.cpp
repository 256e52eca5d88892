#include "experiments/reproduce/claims/appearance_probes.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/reproduce/claims/probes.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {
namespace {

constexpr float kPitch_deg = 35, kEyeHeight_m = 1.6f;
constexpr float kReflectance = 0.6f;
constexpr float kLampRadiance_cd_m2 = 1500, kWindowRadiance_cd_m2 = 600, kSky_cd_m2 = 100;

/// One row of lamps; radii grow with distance, so that all reflections are about equally large in the image.
struct LampRow {
  float distance_m, height_m, radius_m;
  std::vector<float> x_m;
};

const std::vector<LampRow>& lamp_rows() {
  static const std::vector<LampRow> kRows{{3, 1.4f, 0.055f, {-1.4f, -0.73f, 0.02f, 0.7f, 1.38f}},
                                          {5, 1.6f, 0.08f, {-2.0f, -1.15f, -0.4f, 0.35f}},
                                          {8, 1.4f, 0.11f, {-2.6f, -1.35f, 0.05f, 1.25f, 2.6f}}};
  return kRows;
}

Rgb floor_albedo(const SurfacePoint& point) {
  // Features of 0.25 m: five pixels or more everywhere, so that interpolation hardly blurs them.
  const float mottle = 1 + 0.2f * gradient_noise(point.position_m * 4, 61);
  return Rgb{1, 0.97f, 0.92f} * (kReflectance * mottle);
}

/// Ripples as on calm water: three octaves of noise with wavelengths from 0.7 m down.
NormalTexture ripples(double slope) {
  return [strength = static_cast<float>(slope)](const SurfacePoint& point) {
    float slope_x = 0, slope_y = 0, frequency = 1.4f, amplitude = 1;
    constexpr int kOctaves = 3;
    for (std::uint32_t octave = 0; octave < kOctaves; ++octave) {
      const Vec3 p = point.position_m * frequency;
      slope_x += amplitude * gradient_noise({p.x(), p.y(), 0.5f}, 200 + octave);
      slope_y += amplitude * gradient_noise({p.x(), p.y(), 7.5f}, 300 + octave);
      frequency *= 2.3f;
      amplitude *= 0.72f;
    }
    // The sum of the octaves has a root mean square of about 0.37.
    constexpr float kUnit = 1 / 0.37f;
    return Vec3(-strength * kUnit * slope_x, -strength * kUnit * slope_y, 1).normalized();
  };
}

Material floor_material(const FloorLook& look) {
  Material material;
  material.albedo = floor_albedo;
  switch (look.kind) {
    case FloorLook::Kind::kMirror:
      material.kind = Material::Kind::kMirror;
      break;
    case FloorLook::Kind::kMetal:
      material.kind = Material::Kind::kMetal;
      material.roughness = [alpha = static_cast<float>(look.roughness)](const SurfacePoint&) {
        return alpha;
      };
      break;
    case FloorLook::Kind::kDiffuse:
      material.kind = Material::Kind::kDiffuse;
      break;
  }
  if (look.ripple_slope > 0) material.normal = ripples(look.ripple_slope);
  return material;
}

Material lamp_material(float radiance) {
  Material material;
  material.kind = Material::Kind::kEmitter;
  material.radiance_cd_m2 = {radiance, radiance, radiance};
  return material;
}

}  // namespace

std::string name_of(const FloorLook& look) {
  const char* const rippled = look.ripple_slope > 0 ? "rippled " : "";
  switch (look.kind) {
    case FloorLook::Kind::kMirror:
      return fmt::format("{}mirror", rippled);
    case FloorLook::Kind::kMetal:
      return fmt::format("{}metal α = {:g}", rippled, look.roughness);
    case FloorLook::Kind::kDiffuse:
      return "diffuse";
  }
  return "";
}

std::vector<FloorLamp> floor_lamps() {
  std::vector<FloorLamp> lamps;
  for (const LampRow& row : lamp_rows())
    for (const float x : row.x_m)
      lamps.push_back({{x, row.distance_m, row.height_m}, {x, row.distance_m, -row.height_m}});
  return lamps;
}

Scene floor_probe(const FloorLook& look) {
  Scene scene = empty_probe("claim-floor", kSky_cd_m2);
  const float pitch = kPitch_deg * static_cast<float>(EIGEN_PI) / 180;
  scene.camera.centre_m = {0, 0, kEyeHeight_m};
  scene.camera.forward = {0, std::cos(pitch), -std::sin(pitch)};
  scene.camera.up = {0, std::sin(pitch), std::cos(pitch)};
  add_surface(scene, floor_material(look), parallelogram({-20, -5, 0}, {40, 0, 0}, {0, 45, 0}));
  Mesh lamps;
  for (const LampRow& row : lamp_rows())
    for (const float x : row.x_m)
      append(lamps,
             placed(ellipsoid(Vec3::Constant(row.radius_m), 12), Vec3(x, row.distance_m, row.height_m)));
  Material lamp = lamp_material(kLampRadiance_cd_m2);
  lamp.two_sided = false;
  add_surface(scene, lamp, lamps);
  const Mesh window = parallelogram({1.0f, 5.5f, 1.2f}, {1.2f, 0, 0}, {0, 0, 1.2f});
  add_surface(scene, lamp_material(kWindowRadiance_cd_m2), window);
  scene.max_bounces = 2;
  seal(scene);
  return scene;
}

Scene dust_probe(const DustLook& look) {
  Scene scene = empty_probe("claim-dust", 100);
  Material wall;
  wall.albedo = [](const SurfacePoint& point) {
    return Rgb{0.3f, 0.27f, 0.24f} * (1 + 0.15f * gradient_noise(point.position_m * 1.5f, 67));
  };
  add_surface(scene, wall, card({0, static_cast<float>(kDustWallDepth_m), 0}, 14, 9));
  if (look.post) {
    Material post;
    post.albedo = [](const SurfacePoint&) { return Rgb{0.12f, 0.08f, 0.05f}; };
    add_surface(scene, post, block({-0.3f, 3, 0}, {0.4f, 0.1f, 4}));
  }
  // From behind the wall's plane on the right: lights the dust, but no surface that the camera sees.
  scene.sun = Sun{.direction = Vec3(0.9f, 0.1f, 0.42f).normalized(), .illuminance_lx = {8000, 7600, 6800}};
  if (look.scattering_per_m > 0)
    scene.medium = Medium{.min_m = look.centre_m - look.size_m / 2,
                          .max_m = look.centre_m + look.size_m / 2,
                          .scattering_per_m = look.scattering_per_m,
                          .absorption_per_m = 0,
                          .anisotropy = 0};
  scene.max_bounces = 2;
  seal(scene);
  return scene;
}

ImagePoint project(const GridCamera& camera, const ViewGrid& grid, CameraPosition position,
                   const Vec3& point) {
  const Vec3 right = camera.forward.cross(camera.up);
  const double s = (position.s - (grid.columns - 1) / 2.0) * grid.spacing_x_m;
  const double t = (position.t - (grid.rows - 1) / 2.0) * grid.spacing_y_m;
  const Vec3 eye = camera.centre_m + static_cast<float>(s) * right - static_cast<float>(t) * camera.up;
  const Vec3 way = point - eye;
  const double depth = way.dot(camera.forward);
  const double disparity = grid.disparity_px(depth);
  const double pixels_per_tangent = disparity * depth / grid.spacing_x_m;
  return {grid.width / 2.0 + way.dot(right) / depth * pixels_per_tangent,
          grid.height / 2.0 - way.dot(camera.up) / depth * pixels_per_tangent, disparity};
}

}  // namespace plenolab
