#pragma once

#include "stimuli/scene.h"

namespace plenolab {

/// The room of both cellar scenes: 5 × 10 × 2.45 m, stone walls and flagged floor, a board ceiling with slits
/// on joists and a girder on timber posts, a window in the far wall through which the sun comes in, a hatch
/// in the left wall and a door behind the cameras.
///
/// Light: sun of 100 000 lx at 24° elevation, 14° right of the viewing axis, clear sky (thousands of cd/m²),
/// two oil lamps of 6 000 cd/m²; surfaces inside reach 0.2–100 cd/m², sunlit patches about 10 000 cd/m², the
/// sun itself, seen through a slit by some cameras, 1.5·10⁹ cd/m². Slits, window, hatch and door are sky
/// portals. Surfaces are lit directly only (see Scene::max_bounces).
Scene cellar_room();

}  // namespace plenolab
