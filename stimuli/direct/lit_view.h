#pragma once

#include <memory>

#include "core/image/image.h"
#include "stimuli/direct/lit_scene.h"

namespace plenolab {

/// A pinhole camera anywhere in a scene: principal point in the image centre, square pixels.
struct LitCamera {
  Vec3 position_m{0, 0, 0};
  Vec3 forward{0, 1, 0}, up{0, 0, 1};  ///< unit, orthogonal
  float fov_h_deg = 60;                ///< full horizontal opening angle
};

/// What that camera sees at the centre of each pixel, without anti-aliasing.
struct LitView {
  SceneImage radiance;   ///< cd/m²
  Plane<float> depth_m;  ///< planar; ∞ where nothing is
  Plane<int> material;   ///< index into Scene::materials, −1 where nothing is
};

/// A lit scene ready for views that also say which surface each pixel shows. Deterministic, thread-safe,
/// cheap to copy; copies share.
class LitViews {
 public:
  /// Throws InputError as LitRays does.
  explicit LitViews(const LitScene& scene);

  LitView render(const LitCamera& camera, int width, int height, int threads = 0) const;
  /// Depth and materials alone; the radiance is empty.
  LitView surfaces(const LitCamera& camera, int width, int height, int threads = 0) const;

 private:
  struct State;
  LitView trace(const LitCamera& camera, int width, int height, bool lit, int threads) const;
  std::shared_ptr<const State> state_;
};

}  // namespace plenolab
