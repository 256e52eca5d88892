#pragma once

#include "stimuli/scene.h"

namespace plenolab {

/// The room of both cellar scenes: 5 × 10 × 2.45 m, stone walls and flagged floor, a board ceiling with slits
/// on joists and a girder on timber posts, a window in the far wall through which the sun comes in, a hatch
/// in the left wall and a door behind the cameras.
///
/// Light: sun of 100 000 lx at 24° elevation, 14° right of the viewing axis, clear sky (thousands of cd/m²);
/// surfaces inside reach 0.5–60 cd/m², sunlit streaks about 5 000 cd/m². Slits, window, hatch and door are
/// sky portals.
Scene cellar_room();

}  // namespace plenolab
