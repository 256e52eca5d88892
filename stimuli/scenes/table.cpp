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

}  // namespace

std::span<const SceneEntry> scenes() {
  return kScenes;
}

Scene build_scene(std::string_view id) {
  std::string known;
  for (const SceneEntry& entry : kScenes) {
    if (id == entry.id) return entry.build();
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.id);
  }
  throw InputError(fmt::format("There is no scene '{}'; choose one of: {}.", id, known));
}

}  // namespace plenolab
