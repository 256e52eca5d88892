#pragma once

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

/// Things that stand about in scenes. Wooden parts carry numbers, so that every board has its own tone.

/// Standing cask of staves with four iron hoops, its foot at the origin.
void add_barrel(SceneAssembler& scene, int wood, int iron, const Eigen::Affine3f& at, float height_m,
                int number);

/// Slatted crate with an open top, its foot at the origin.
void add_crate(SceneAssembler& scene, int wood, const Eigen::Affine3f& at, const Vec3& size_m, int number);

/// Bottle, its foot at the origin.
Mesh bottle(float height_m);

/// Round-bellied jar with a lid, its foot at the origin.
Mesh jar(float height_m);

/// Ladder that leans between two points of its axis.
Mesh ladder(const Vec3& foot_m, const Vec3& top_m, const Vec3& sideways, float width_m, int number);

}  // namespace plenolab
