#pragma once

#include <span>
#include <string_view>

#include "stimuli/direct/lit_scene.h"
#include "stimuli/scene.h"

namespace plenolab {

/// One procedural scene: `id` names it on the command line, `title` is for people, `build` models it.
struct SceneEntry {
  const char* id;
  const char* title;
  Scene (*build)();
};

/// The scenes for synthesis and tone mapping, in the order of reports. Adding one is one file in this folder
/// and one line in table.cpp.
std::span<const SceneEntry> scenes();

/// The scenes for the near-eye light-field display, kept apart: seen from 12 cm to 6 m by cameras 1 mm apart,
/// diffuse, lit by a sun and an even sky.
std::span<const SceneEntry> near_eye_scenes();

/// A scene for displays whose pixels are rays, with lamps of its own.
struct LitSceneEntry {
  const char* id;
  const char* title;
  LitScene (*build)();
};
std::span<const LitSceneEntry> display_scenes();
/// Throws InputError, which lists the known ids, for a name that is not in that table.
LitScene build_display_scene(std::string_view id);

/// Models the scene of either table called `id`: the same meshes, bit by bit, at every call. Throws
/// InputError, which lists the known ids, for any other name.
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
Scene build_near_eye_1();
Scene build_near_eye_2();
Scene build_near_eye_3();
Scene build_near_eye_4();
Scene build_near_eye_5();
LitScene build_pillars();
LitScene build_sphere();

}  // namespace plenolab
