#pragma once

#include "stimuli/direct/game_sequences.h"
#include "stimuli/scenes/modelling/assembler.h"

namespace plenolab {

/// Collects the parts of a game-like scene. Sizes and positions in metres, z up; albedos in [0, 1].
class GameBuilder {
 public:
  int matte(Rgb albedo);
  /// Two tones in squares of `tile_m` over x and y.
  int tiles(Rgb light, Rgb dark, float tile_m);
  /// Diffuse base that also mirrors.
  int polished(Rgb albedo, float ior = 1.5f);
  int shining(Rgb radiance_cd_m2);

  void block(int material, const Vec3& centre_m, const Vec3& size_m, float yaw_deg = 0);
  void ball(int material, const Vec3& centre_m, float radius_m);
  void column(int material, const Vec3& foot_m, float radius_m, float height_m);
  void part(int material, const Mesh& mesh) { parts_.add(material, mesh); }

  /// Slabs around the inside [low, high]; walls in the order left (−x), right, front (+y), back.
  void room(const Vec3& low_m, const Vec3& high_m, int floor, int walls, int ceiling);

  void lamp(const Vec3& position_m, Rgb intensity_cd);
  void distant(const Vec3& direction, Rgb illuminance_lx);
  /// Even light from above and below.
  void ambient(Rgb above_cd_m2, Rgb below_cd_m2);

  /// Ends the building.
  GameScene finish(const char* id, Environment environment, GameCamera first, GameCamera last);

 private:
  SceneAssembler parts_;
  LitScene lit_;
};

/// Radiance from `horizon` to `zenith` by height; below the horizon `horizon`.
Environment open_sky(Rgb zenith_cd_m2, Rgb horizon_cd_m2);

}  // namespace plenolab
