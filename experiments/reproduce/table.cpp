#include <array>

#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_scene_overview(Laboratory& laboratory);
ReproductionResult reproduce_synthesis_quality(Laboratory& laboratory);
ReproductionResult reproduce_synthesis_sweep(Laboratory& laboratory);
ReproductionResult reproduce_pruning(Laboratory& laboratory);

std::span<const Reproduction> reproductions() {
  static constexpr std::array kItems{
      Reproduction{"altmeier-fig-11", "The scenes", Chapter::kScenes, reproduce_scene_overview},
      Reproduction{"synthesis-quality", "Synthesised views against ground truth", Chapter::kQuality,
                   reproduce_synthesis_quality},
      Reproduction{"sweep-synthesis", "Error against run time of view synthesis", Chapter::kSpeed,
                   reproduce_synthesis_sweep},
      Reproduction{"pruning", "What was left out, and what that saved", Chapter::kSpeed, reproduce_pruning},
  };
  return kItems;
}

}  // namespace plenolab
