#pragma once

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

/// An open wooden boat, bow towards +y, waterline at z = 0.
struct BoatLook {
  float length_m = 4.2f, beam_m = 1.5f, side_m = 0.5f;  ///< side: height of the gunwale above water amidships
  float draught_m = 0.18f;
  int thwarts = 3;
  int number = 0;
};

/// Clinker-built hull of `paint`, gunwales, thwarts and floor boards of `wood`.
void add_boat(SceneAssembler& scene, int paint, int wood, const Eigen::Affine3f& at, const BoatLook& look);

/// Where ropes and masts are fixed, in the boat's own axes.
Vec3 boat_bow(const BoatLook& look);
Vec3 boat_stern(const BoatLook& look);

/// Materials of a paper lantern: bright belly, dimmer shoulders, dark caps.
struct LanternMaterials {
  int belly, shoulder, cap;
};

/// Paper lantern that hangs from `top_m`, `height_m` tall.
void add_lantern(SceneAssembler& scene, const LanternMaterials& materials, const Vec3& top_m, float height_m);

/// A rope with lanterns hung from it at even distances.
struct LanternRope {
  Vec3 from_m, to_m;
  float sag_m = 0.3f;
  int lanterns = 4;
  float lantern_m = 0.32f;
};
void add_lantern_rope(SceneAssembler& scene, int rope, const std::vector<LanternMaterials>& kinds,
                      const LanternRope& look);

}  // namespace plenolab
