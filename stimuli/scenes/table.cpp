#include "stimuli/scenes/table.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "core/base/error.h"

namespace plenolab {
namespace {

constexpr std::array kScenes{
    SceneEntry{"cellar", "Cellar", build_cellar},
    SceneEntry{"cellar-shafts", "Cellar with light shafts", build_cellar_shafts},
    SceneEntry{"tunnel", "Tunnel", build_tunnel},
    SceneEntry{"tree", "Tree", build_tree},
    SceneEntry{"boats", "Boats and Lanterns", build_boats},
    SceneEntry{"dunes", "Dunes", build_dunes},
    SceneEntry{"dominoes", "Dominoes", build_dominoes},
    SceneEntry{"desk", "Desk", build_desk},
};

constexpr std::array kNearEyeScenes{
    SceneEntry{"near-eye-1", "Many objects", build_near_eye_1},
    SceneEntry{"near-eye-2", "Few objects", build_near_eye_2},
    SceneEntry{"near-eye-3", "Objects behind each other", build_near_eye_3},
    SceneEntry{"near-eye-4", "Curved surfaces", build_near_eye_4},
    SceneEntry{"near-eye-5", "Extreme occlusion", build_near_eye_5},
};

constexpr std::array kDisplayScenes{
    LitSceneEntry{"pillars", "Pillars", build_pillars},
    LitSceneEntry{"sphere", "Sphere", build_sphere},
};

}  // namespace

std::span<const SceneEntry> scenes() {
  return kScenes;
}

std::span<const SceneEntry> near_eye_scenes() {
  return kNearEyeScenes;
}

std::span<const LitSceneEntry> display_scenes() {
  return kDisplayScenes;
}

LitScene build_display_scene(std::string_view id) {
  std::string known;
  for (const LitSceneEntry& entry : display_scenes()) {
    if (id == entry.id) return entry.build();
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.id);
  }
  throw InputError(fmt::format("There is no scene '{}' for displays; choose one of: {}.", id, known));
}

Scene build_scene(std::string_view id) {
  std::string known;
  for (const std::span<const SceneEntry> table : {scenes(), near_eye_scenes()})
    for (const SceneEntry& entry : table) {
      if (id == entry.id) return entry.build();
      known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.id);
    }
  throw InputError(fmt::format("There is no scene '{}'; choose one of: {}.", id, known));
}

}  // namespace plenolab
