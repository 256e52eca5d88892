#pragma once

#include "stimuli/scenes/modelling/assembler.h"

namespace plenolab {

/// The bright ring about a low sun: light that haze and dust scatter forwards by a few degrees. Its radiance
/// falls with the angle γ from the centre of the disc as (γ_limb/γ)^power, less the value at its end, on top
/// of the sky's own.
struct AureoleLook {
  Rgb limb_cd_m2;             ///< at the edge of the disc
  float power = 3;            ///< of the fall
  float radius_deg = 14;      ///< where it ends
  int rings = 120;            ///< steps from the limb outwards, evenly in log γ
  int sectors = 48;           ///< around the sun; the sky behind differs between them
  float distance_m = 1000e3;  ///< far enough for every camera and surface to see the sun in its middle
};

/// Adds rings of light sources around the sun of `scene`, whose sun and sky must be set; those below the
/// horizon are left out. The disc shines through the hole in the middle. Each piece has the radiance of the
/// sky behind its centre and of the aureole together, since a source hides the sky.
void add_aureole(SceneAssembler& parts, const Scene& scene, const AureoleLook& look);

}  // namespace plenolab
