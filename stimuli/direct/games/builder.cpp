#include "stimuli/direct/games/builder.h"

#include <algorithm>
#include <cmath>

#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {

int GameBuilder::matte(Rgb albedo) {
  return parts_.material(diffuse(plain(albedo)));
}

int GameBuilder::tiles(Rgb light, Rgb dark, float tile_m) {
  return parts_.material(diffuse([=](const SurfacePoint& point) {
    const auto cell = [&](float v) { return static_cast<int>(std::floor(v / tile_m)); };
    return (cell(point.position_m.x()) + cell(point.position_m.y())) % 2 == 0 ? light : dark;
  }));
}

int GameBuilder::polished(Rgb albedo, float ior) {
  return parts_.material(glossy(plain(albedo), {}, ior));
}

int GameBuilder::shining(Rgb radiance_cd_m2) {
  return parts_.material(plenolab::lamp(radiance_cd_m2));
}

void GameBuilder::block(int material, const Vec3& centre_m, const Vec3& size_m, float yaw_deg) {
  const float bevel = std::min(0.01f, 0.1f * size_m.minCoeff());
  parts_.add(material, placed(bevelled_box(size_m, bevel), pose(centre_m, yaw_deg)));
}

void GameBuilder::ball(int material, const Vec3& centre_m, float radius_m) {
  parts_.add(material, placed(ellipsoid(Vec3::Constant(radius_m), 48), centre_m));
}

void GameBuilder::column(int material, const Vec3& foot_m, float radius_m, float height_m) {
  parts_.add(material, rod(foot_m, foot_m + Vec3(0, 0, height_m), radius_m, 0.9f * radius_m, 32));
}

void GameBuilder::room(const Vec3& low_m, const Vec3& high_m, int floor, int walls, int ceiling) {
  constexpr float kThick = 0.3f;
  const Vec3 size = high_m - low_m, middle = (low_m + high_m) / 2;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      Vec3 centre = middle, extent = size + Vec3::Constant(2 * kThick);
      centre[axis] += static_cast<float>(side) * (size[axis] + kThick) / 2;
      extent[axis] = kThick;
      block(axis < 2 ? walls : side < 0 ? floor : ceiling, centre, extent);
    }
}

void GameBuilder::lamp(const Vec3& position_m, Rgb intensity_cd) {
  lit_.points.push_back({position_m, intensity_cd});
}

void GameBuilder::distant(const Vec3& direction, Rgb illuminance_lx) {
  lit_.directions.push_back({direction.normalized(), illuminance_lx});
}

void GameBuilder::ambient(Rgb above_cd_m2, Rgb below_cd_m2) {
  lit_.scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = above_cd_m2, .ground_cd_m2 = below_cd_m2};
}

GameScene GameBuilder::finish(const char* id, Environment environment, GameCamera first, GameCamera last) {
  parts_.finish(lit_.scene);
  lit_.scene.id = id;
  lit_.scene.title = id;
  lit_.environment = std::move(environment);
  return {std::move(lit_), first, last};
}

Environment open_sky(Rgb zenith_cd_m2, Rgb horizon_cd_m2) {
  return [=](const Vec3& direction) {
    return mix(horizon_cd_m2, zenith_cd_m2, 1.5f * std::max(0.0f, direction.z()));
  };
}

}  // namespace plenolab
