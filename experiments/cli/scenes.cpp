#include "experiments/cli/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.h"
#include "experiments/cli/suggest.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

Scene scene_named(const std::string& id) {
  std::vector<std::string> known;
  for (const SceneEntry& entry : scenes()) known.emplace_back(entry.id);
  if (std::find(known.begin(), known.end(), id) == known.end())
    throw UsageError(fmt::format("there is no scene '{}'{} (there are: {})", id, did_you_mean(id, known),
                                 fmt::join(known, ", ")));
  return build_scene(id);
}

}  // namespace plenolab
