#pragma once

#include <string>

#include "stimuli/scene.h"

namespace plenolab {

/// The scene that a command line names. Throws UsageError with the nearest id and all others if there is
/// none.
Scene scene_named(const std::string& id);

}  // namespace plenolab
