#pragma once

#include <functional>

#include "stimuli/scene.h"

namespace plenolab {

/// How a broad-leaved tree grows: branches fork level by level, the last levels carry leaves.
struct TreeLook {
  float trunk_m = 2.1f;      ///< length of the trunk up to its first fork
  float radius_m = 0.3f;     ///< at the foot
  int levels = 5;            ///< forks from trunk to twig
  int children = 6;          ///< branches that leave one branch
  float bare_share = 0.12f;  ///< of the boughs (third level) that are dead and show their twigs
  int leaves_per_twig = 15;
  float leaf_m = 0.12f;
  std::uint32_t seed = 1;
};

struct TreeMeshes {
  Mesh branches;  ///< tubes, numbered
  Mesh leaves;    ///< numbered; u across [−½, ½] and v along [0, 1] of each leaf
};

/// Grows a tree from `foot_m` upwards.
TreeMeshes grow_tree(const Vec3& foot_m, const TreeLook& look);

/// A horizontal area seen from a camera, in which grass is denser near by: blades on a half-open wedge around
/// +y.
struct GrassLook {
  float near_m = 3, far_m = 16;  ///< distance from the origin
  float half_angle_deg = 42;
  int blades = 40000;
  float height_m = 0.28f, width_m = 0.009f;
  std::uint32_t seed = 1;
};

/// Bent blades of grass, numbered, standing on a terrain z(x, y). u across, v from root 0 to tip 1.
Mesh grass(const GrassLook& look, const std::function<float(float x, float y)>& terrain_m);

}  // namespace plenolab
