#pragma once

#include <memory>

#include "core/image/image.h"
#include "core/lightfield/view_grid.h"
#include "stimuli/scene.h"

namespace plenolab {

/// What rasterisation shows: one sample at the centre of each pixel, no anti-aliasing, and light straight
/// from sun and sky. Deterministic, without noise, the same for every camera that sees a point.
struct DirectView {
  SceneImage radiance;   ///< cd/m²
  Plane<float> depth_m;  ///< planar, exact at the pixel centre; ∞ where nothing is
};

/// A scene ready for direct views. Light, which does not depend on the view: Lambert's law for albedo, the
/// sun with hard shadows, the sky's zenith colour from above and its ground colour from below, blended by the
/// slope of the surface, without occlusion. Every material counts as diffuse but emitters, which shine.
/// Cheap to copy; copies share.
class DirectScene {
 public:
  /// Throws InputError as validate() does.
  explicit DirectScene(const Scene& scene);
  const Scene& scene() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::shared_ptr<const State> state_;
};

/// The camera at `position` of `grid`: stands and looks as in render_view (stimuli/render.h).
DirectView render_direct(const DirectScene& scene, const ViewGrid& grid, CameraPosition position,
                         int threads = 0);

/// All views of the grid side by side in one image: view (c, r) covers pixels [c·width, (c + 1)·width) ×
/// [r·height, (r + 1)·height).
DirectView render_direct_views(const DirectScene& scene, const ViewGrid& grid, int threads = 0);

}  // namespace plenolab
