#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cli/wide_table.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/mappings.h"

namespace plenolab {

ReproductionResult reproduce_consistency_table(Laboratory& laboratory);

namespace {

constexpr const char* kScenes[] = {"cellar", "dunes", "dominoes", "desk"};

}  // namespace

ReproductionResult reproduce_consistency_table(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  for (const char* scene : kScenes)
    for (const Mapping& mapping : mappings_for(bench, scene, all_shown())) {
      const MappedMotion& motion = bench.motion(scene, mapping);
      result.rows.append(motion.summary);
      const std::vector<double> track = adaptation_track(motion);
      const auto [low, high] = std::minmax_element(track.begin(), track.end());
      result.rows.add({"adaptation_range",
                       *high - *low,
                       "luma",
                       {{"scene", std::string(scene)}, {"mapping", mapping.label}}});
    }
  return result;
}

}  // namespace plenolab
