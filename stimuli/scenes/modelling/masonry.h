#pragma once

#include <optional>

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

/// How stones of a wall or floor are cut and laid, lengths in metres.
struct MasonryLook {
  float course_min = 0.16f, course_max = 0.28f;  ///< heights of courses
  float stone_min = 0.22f, stone_max = 0.55f;    ///< lengths of stones
  float depth = 0.2f;                            ///< of a stone behind the face
  float joint = 0.014f;                          ///< gap between stones
  float rounding = 0.03f;                        ///< of edges, less than half of the smallest side
  float roughness = 0.014f;                      ///< largest displacement of the face
  float proud = 0.012f;                          ///< stones stand forward or back by up to this much
  float mortar_back = 0.022f;                    ///< mortar lies this far behind the face
  int cuts = 4;                                  ///< subdivisions of a stone's side
  std::uint32_t seed = 1;
};

/// Courses of numbered stones over [0, length] × [0, height] in the x-z plane, facing −y.
Mesh stone_courses(float length_m, float height_m, const MasonryLook& look);

/// Flat rectangle [x0, x1] × [z0, z1] in the x-z plane at y, facing −y. 2 triangles.
Mesh upright_rectangle(float x0, float x1, float z0, float z1, float y);

/// A window or door in a wall: [x0, x1] × [z0, z1] of the wall's own x-z plane.
struct WallOpening {
  float x0, x1, z0, z1;
};

/// Stone wall with mortar over [0, length] × [0, height] of its own x-z plane, facing −y, around an opening
/// whose reveal is `reveal` deep, placed by `at`.
void add_stone_wall(SceneAssembler& scene, int stone, int mortar, const Eigen::Affine3f& at, float length_m,
                    float height_m, const MasonryLook& look, const std::optional<WallOpening>& opening = {},
                    float reveal_m = 0.3f);

}  // namespace plenolab
