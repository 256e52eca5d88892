#pragma once

#include "stimuli/direct/game_sequences.h"

namespace plenolab {

/// The scenes of the game-like sequences (stimuli/direct/game_sequences.h).
GameScene build_reflections();
GameScene build_effects_cave_2();
GameScene build_effects_cave();
GameScene build_realistic_reflections();
GameScene build_temple();
GameScene build_realistic_reflections_2();
GameScene build_sun_temple();
GameScene build_research_lab();
GameScene build_vehicle_game();
GameScene build_living_room();

}  // namespace plenolab
