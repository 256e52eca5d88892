#pragma once

#include "stimuli/scene.h"

namespace plenolab {

/// How scenes are recorded: what their cameras and grids have in common.

/// A camera grid centred at `centre_m` that looks along +y, tilted upwards by `pitch_deg`; opening angle
/// `fov_h_deg` across.
GridCamera camera_along_y(const Vec3& centre_m, float fov_h_deg, float pitch_deg = 0);

/// 5 × 3 key views of 384 × 216 pixels.
GridPreset quick_views(double spacing_x_m, double spacing_y_m, int paths_per_pixel);

/// The thesis' grids (section 3.1): 17 × `rows` key views, as far apart across as up, of 960 × 540 pixels.
GridPreset paper_views(double spacing_m, int rows = 9, int paths_per_pixel = 512);

}  // namespace plenolab
