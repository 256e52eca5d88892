#include "experiments/cli/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "core/base/error.h"
#include "experiments/cli/suggest.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

Scene scene_named(const std::string& id) {
  std::vector<std::string> known;
  for (const std::span<const SceneEntry> table : {scenes(), near_eye_scenes()})
    for (const SceneEntry& entry : table) known.emplace_back(entry.id);
  if (std::find(known.begin(), known.end(), id) == known.end())
    throw UsageError(fmt::format("there is no scene '{}'{} (there are: {})", id, did_you_mean(id, known),
                                 fmt::join(known, ", ")));
  return build_scene(id);
}

}  // namespace plenolab
