#pragma once

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

/// Shading normal of sand under wind ripples: crests across `along`, bent and forked by noise, as deep as
/// `slope` and fading out at `fade_m` from the origin, where they would be finer than a pixel.
struct RippleLook {
  Vec3 along{1, 0, 0};  ///< unit, horizontal: the way the wind blows
  float wavelength_m = 0.16f;
  float slope = 0.32f;
  float fade_m = 22;
  std::uint32_t seed = 1;
};
NormalTexture sand_ripples(const RippleLook& look);

/// Date palm, its foot at the origin of `at`: bent ringed trunk, crown of drooping fronds with leaflets.
struct PalmLook {
  float height_m = 7;
  float lean_m = 0.8f;  ///< of the crown against the foot, along x
  int fronds = 26;
  float frond_m = 2.6f;
  std::uint32_t seed = 1;
};
void add_palm(SceneAssembler& scene, int trunk, int leaves, const Eigen::Affine3f& at, const PalmLook& look);

/// Tuft of stiff grass, its foot at the origin: bent blades that spread from one place.
struct TuftLook {
  int blades = 60;
  float height_m = 0.6f, spread_m = 0.3f, width_m = 0.008f;
  std::uint32_t seed = 1;
};
Mesh tuft(const TuftLook& look);

}  // namespace plenolab
