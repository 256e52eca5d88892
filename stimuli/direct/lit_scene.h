#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/image/image.h"
#include "stimuli/scene.h"

namespace plenolab {

/// A lamp without size: illuminance on a surface facing it is intensity/distance².
struct PointLight {
  Vec3 position_m{0, 0, 1};
  Rgb intensity_cd{1, 1, 1};
};

/// Light from infinitely far.
struct DirectionalLight {
  Vec3 direction{0, 0, 1};  ///< unit, from the scene to the light
  Rgb illuminance_lx{};     ///< on a surface facing it
};

/// Radiance that leaves the scene's surroundings towards it, as a function of the (unit) direction to them.
/// Pure; called from many threads.
using Environment = std::function<Rgb(const Vec3& direction)>;

/// A scene with lamps of its own instead of sun and sky, for displays whose every pixel is a ray
/// (core/luminance): the screen is the plane y = 0 of the world, centred, x to the right and z up; observers
/// look along +y.
struct LitScene {
  Scene scene;  ///< meshes and materials; of its light only the sky counts, as ambient light (below)
  std::vector<PointLight> points;
  std::vector<DirectionalLight> directions;
  Environment environment;  ///< seen behind everything; empty: black
};

/// A lit scene ready for rays. Deterministic, without noise, the same from everywhere: Lambert's law for
/// albedo with hard shadows of all lamps, and as ambient light the sky's zenith colour from above and its
/// ground colour from below, blended by the slope of the surface, without occlusion. Every material counts as
/// diffuse but emitters, which shine. Thread-safe, cheap to copy; copies share.
class LitRays {
 public:
  /// Throws InputError as validate() does, or for a lamp with a direction that is no unit vector.
  explicit LitRays(const LitScene& scene);
  const LitScene& scene() const;

  /// cd/m², of what a ray from `origin_m` along a unit `direction` meets first.
  Rgb radiance(const Vec3& origin_m, const Vec3& direction) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace plenolab
