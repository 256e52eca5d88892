#pragma once

#include <array>
#include <string>
#include <vector>

#include "stimuli/direct/lit_scene.h"

namespace plenolab {

/// A scene to walk through, for methods that colour pictures by the place they show: three buildings with
/// moods of their own (a corridor, a hall, a garden house) two metres apart in an open park, joined by a
/// carpet, a pipe, a pergola and a bench that reach from one into the next. x to the right, y ahead, z up;
/// the walk begins in the corridor and goes along +y into the hall, then along +x into the garden house.

/// A building with everything between its walls.
struct WalkRoom {
  const char* name;
  Vec3 min_m, max_m;
};

struct WalkScene {
  LitScene lit;
  /// Every object has a material of its own: names by index into Scene::materials.
  std::vector<std::string> objects;
  std::array<WalkRoom, 3> rooms;  ///< corridor, hall, garden house
};

/// The same scene, bit by bit, at every call. Luminance is 5 to 500 cd/m² nearly everywhere.
WalkScene build_walk_scene();

}  // namespace plenolab
