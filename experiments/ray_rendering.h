#pragma once

#include <utility>
#include <vector>

#include "core/luminance/ray_images.h"
#include "stimuli/direct/lit_scene.h"

namespace plenolab {

/// Scenes seen through the screen of a display (core/luminance/ray_display.h): a point (x, y, z) of the
/// display's space is (x, −z, y) of the scene's world.
struct RayRendering {
  int samples_across = 2;  ///< points a pixel, across and down; 1 to 8
  int threads = 0;
};

/// Every ray of the display: the radiance that would reach its observer position along the line through its
/// place on the screen. That also fixes the vertical parallax of displays that have none: right at the
/// observers' distance.
SceneRays render_rays(const LitRays& scene, const RayDisplay& display, const RayRendering& rendering = {});

/// Only the columns named as (image, u); the others stay black.
SceneRays render_columns(const LitRays& scene, const RayDisplay& display,
                         const std::vector<std::pair<int, int>>& columns, const RayRendering& rendering = {});

/// What a pinhole camera at the observer position would record of the scene itself, framed by the screen: the
/// ground truth of what the display shows there.
SceneImage render_pinhole(const LitRays& scene, const DisplaySpace& space, ObserverPosition observer,
                          PinholeSize size, const RayRendering& rendering = {});

}  // namespace plenolab
