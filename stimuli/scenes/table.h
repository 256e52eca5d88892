#pragma once

#include <span>
#include <string_view>

#include "stimuli/scene.h"

namespace plenolab {

/// One procedural scene: `id` names it on the command line, `title` is for people, `build` models it.
struct SceneEntry {
  const char* id;
  const char* title;
  Scene (*build)();
};

/// All scenes, in the order of reports. Adding one is one file in this folder and one line in table.cpp.
std::span<const SceneEntry> scenes();

/// Models the scene called `id`: the same meshes, bit by bit, at every call. Throws InputError, which lists
/// the known ids, for any other name.
Scene build_scene(std::string_view id);

/// The scenes, one file each. See the head of each file for what it shows, its photometric set-up and what it
/// provokes.
Scene build_cellar();
Scene build_cellar_shafts();
Scene build_tunnel();
Scene build_tree();
Scene build_boats();
Scene build_dunes();
Scene build_dominoes();
Scene build_desk();

}  // namespace plenolab
