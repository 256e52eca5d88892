#include "stimuli/scenes/modelling/aureole.h"

#include <cmath>

#include "core/base/error.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/tracer/sky_light.h"

namespace plenolab {
namespace {

constexpr float kPi = static_cast<float>(EIGEN_PI);

/// Directions at an angle from the sun's centre and around it.
struct AroundSun {
  Vec3 centre, right, up;

  explicit AroundSun(const Vec3& sun)
      : centre(sun), right(sun.cross(Vec3::UnitZ()).normalized()), up(right.cross(sun)) {}
  Vec3 at(float angle, float turn) const {
    return std::cos(angle) * centre + std::sin(angle) * (std::cos(turn) * right + std::sin(turn) * up);
  }
};

/// One piece between two angles and two turns, facing the scene.
Mesh piece(const AroundSun& around, std::array<float, 2> angles, std::array<float, 2> turns, float distance) {
  constexpr int kCuts = 4;  // keeps the inner rim round
  return surface(kCuts, 1, [&](float u, float v) {
    const float angle = angles[1] + v * (angles[0] - angles[1]);
    const float turn = turns[0] + u * (turns[1] - turns[0]);
    return Vec3(distance * around.at(angle, turn));
  });
}

}  // namespace

void add_aureole(SceneAssembler& parts, const Scene& scene, const AureoleLook& look) {
  PLENOLAB_CHECK(scene.sun, "an aureole needs a sun");
  const AroundSun around(scene.sun->direction);
  const tracer::SkyLight sky(scene);
  const float limb = scene.sun->angular_diameter_deg * kPi / 360;
  const float step = std::log(look.radius_deg * kPi / 180 / limb) / static_cast<float>(look.rings);
  const float at_end = std::exp(-look.power * step * static_cast<float>(look.rings));
  const float turn = 2 * kPi / static_cast<float>(look.sectors);
  for (int ring = 0; ring < look.rings; ++ring) {
    const auto k = static_cast<float>(ring);
    const std::array angles{limb * std::exp(step * k), limb * std::exp(step * (k + 1))};
    const float middle = limb * std::exp(step * (k + 0.5f));
    const Rgb glow = look.limb_cd_m2 * (std::pow(limb / middle, look.power) - at_end);
    for (int sector = 0; sector < look.sectors; ++sector) {
      const auto s = static_cast<float>(sector);
      const Vec3 direction = around.at(middle, turn * (s + 0.5f));
      if (direction.z() <= 0) continue;
      const int material = parts.material(lamp(sky.radiance(direction) + glow));
      parts.add(material, piece(around, angles, {turn * s, turn * (s + 1)}, look.distance_m));
    }
  }
}

}  // namespace plenolab
