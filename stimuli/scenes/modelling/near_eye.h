#pragma once

#include "stimuli/scenes/modelling/assembler.h"

namespace plenolab {

/// What the scenes for the near-eye display have in common: 15 × 8 cameras 1 mm apart at the origin that look
/// along +y through square frusta of 19.86° (Hansen & Klein 2016, section 3.1), a sun from the upper left
/// behind them, an even sky, and a back wall 6 m away.

/// Half the width and height of what the cameras see at a distance, without the 15 mm of their array.
float half_extent_m(float distance_m);

/// Floor (at `floor_z_m`) and wall, large enough for every camera, with patterns that are fine enough to show
/// misplaced pixels and coarse enough not to alias: features are about 6 px wide at any distance.
void add_surroundings(SceneAssembler& scene, float floor_z_m, Rgb wall, Rgb floor, std::uint32_t seed);

/// A mottled diffuse material whose blotches are about `features_px` wide at a distance.
int add_mottled(SceneAssembler& scene, Rgb base, Rgb stain, float distance_m, float features_px,
                std::uint32_t seed);

/// Camera, presets and light; moves what was assembled into the scene.
Scene finish_near_eye(SceneAssembler& scene, const char* id, const char* title, const char* description);

}  // namespace plenolab
