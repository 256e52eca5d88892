#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/cli/wide_table.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/measures.h"
#include "experiments/reproduce/tonemap/motion_measures.h"

namespace plenolab {

ReproductionResult reproduce_consistency_table(Laboratory& laboratory);

namespace {

constexpr std::array kScenes{"cellar", "dunes", "dominoes", "desk"};

/// The bilateral operator does not adapt, and is judged by claims of its own: here on one scene.
std::vector<Shown> shown_on(const std::string& scene) {
  std::vector<Shown> shown{
      Shown::kHistogram,       Shown::kReinhardNaive,      Shown::kReinhardJoint, Shown::kReinhardAdjusted,
      Shown::kReinhardResults, Shown::kReinhardStatistics, Shown::kRobust};
  if (scene == "cellar")
    shown.insert(shown.begin(), {Shown::kBilateralNaive, Shown::kBilateralEnhanced, Shown::kHistogramFixed});
  return shown;
}

/// Mapping and size of the largest of a measure over all mappings of a scene.
struct Extreme {
  std::string mapping;
  double value = 0;
};

Extreme add_scene(MappingBench& bench, const std::string& scene, ResultTable& rows) {
  Extreme flicker;
  for (const Mapping& mapping : mappings_for(bench, scene, shown_on(scene))) {
    const MappedMotion& motion = bench.motion(scene, mapping);
    rows.append(motion.summary);
    rows.add({"adaptation_range",
              adaptation_range(motion),
              "luma",
              {{"scene", scene}, {"mapping", mapping.label}}});
    if (const double step = largest_step(motion); step > flicker.value) flicker = {mapping.label, step};
  }
  return flicker;
}

}  // namespace

ReproductionResult reproduce_consistency_table(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  std::string flickers;
  for (const char* scene : kScenes) {
    const Extreme flicker = add_scene(bench, scene, result.rows);
    flickers += fmt::format("{}{} {:.4f} ({})", flickers.empty() ? "" : ", ", laboratory.scene(scene).title,
                            flicker.value, flicker.mapping);
  }
  result.paper_shows =
      "Sections 5 and 6.2 judge consistency by eye, on epipolar images. The measures here are ours: each is "
      "taken relative to the HDR views at the same places, so that what the light itself changes does not "
      "count.";
  result.ours_shows = fmt::format(
      "The camera moves over the middle row of key views (Dunes: the middle column). The largest change of "
      "brightness from one frame to the next, over surfaces under unchanged light: {}. One step of an 8-bit "
      "display is {:.4f}.",
      flickers, kSmallestStep);
  result.differs =
      "Nothing to compare with: the thesis gives no numbers. The claims on consistency in the ledger take "
      "theirs "
      "from the same motions.";
  result.add_table(wide_table(
      result.rows, {"scene", "mapping"},
      {{"frame_change_max", "largest frame change [luma]"},
       {"line_change_rms", "change along lines [luma]"},
       {"adaptation_range", "adaptation [luma]"},
       {"border_excess", "borders"},
       {"motion_luma_min", "darkest frame [luma]"},
       {"motion_luma_max", "brightest frame [luma]"},
       {"motion_luma_step_max", "largest step of mean luma"}},
      "Consistency over a camera motion, every operator on four scenes. Change along lines: RMS change of "
      "luma of "
      "a surface under unchanged light from frame to frame, noise of the key views included. Adaptation: "
      "range of "
      "the brightness of such surfaces over the whole motion; wanted where the light changes (Cellar, "
      "Dunes), "
      "unwanted elsewhere. Borders: differences of neighbouring pixels across borders of visibility over "
      "those "
      "elsewhere, in the mapped frames over the same in the HDR frames; 1 means that mapping adds nothing"));
  return result;
}

}  // namespace plenolab
