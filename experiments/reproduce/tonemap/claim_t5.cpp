// A-T5, thesis section 6.2.1: with stable highlights (Dominoes) or gradual change of light (Dunes) naive
// Reinhard 2005 is free of visible inconsistency inside a view, but for the border region in Dunes.
#include <fmt/format.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/claim_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_t5(Laboratory& laboratory);

namespace {

struct SceneNumbers {
  std::optional<Interval> step, region;
  std::size_t views = 0, views_near_key_views = 0;
};

SceneNumbers measure_scene(MappingBench& bench, const std::string& scene, Shown shown) {
  const auto frames =
      frame_inconsistencies(bench, scene, mapping_for(bench, scene, shown),
                            mapping_for(bench, scene, Shown::kReinhardJoint), bench.views_in_cells(scene));
  // What a key view beside the camera shows is cut off at its border, where others take over: the border
  // region shows most near key views (section 5.1.5).
  const auto near_key_views = frame_inconsistencies(bench, scene, mapping_for(bench, scene, shown),
                                                    mapping_for(bench, scene, Shown::kReinhardJoint),
                                                    bench.views_near_key_views(scene));
  const std::uint64_t seed = bench.laboratory().options().seed;
  return {mean_interval(border_steps(frames), seed, kViewsInCell),
          mean_interval(border_regions(near_key_views), seed, kViewsOfBorders), frames.size(),
          near_key_views.size()};
}

}  // namespace

ReproductionResult reproduce_claim_t5(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  std::vector<MeasuredNumber> steps, regions;
  std::vector<SceneNumbers> naive;
  for (const char* scene : {"dominoes", "dunes", "cellar"}) {
    naive.push_back(measure_scene(bench, scene, Shown::kReinhardNaive));
    steps.push_back({laboratory.scene(scene).title, naive.back().step});
    regions.push_back({laboratory.scene(scene).title, naive.back().region});
  }
  result.paper_shows =
      "Section 6.2.1, figures 39 and 40: naive Reinhard 2005 gives novel views without visible inconsistency "
      "where one highlight decides the extremes in all key views (Dominoes) and where the light changes "
      "gradually (Dunes); there, only the border region of the image is brighter or darker, where the "
      "weights "
      "fade a key view out.";
  result.ours_shows = fmt::format(
      "Steps of luma across borders of visibility (RMS, mean over views within the cells): {} for the "
      "Dominoes "
      "and {} for the Dunes; for comparison {} for the Cellar. The border region of the image differs from "
      "the "
      "rest by {} in the Dunes and {} in the Dominoes. One step of an 8-bit display is {:.4f}.",
      text_of(naive[0].step), text_of(naive[1].step), text_of(naive[2].step), text_of(naive[1].region),
      text_of(naive[0].region), kSmallestStep);
  add_measured(result, "Naive Reinhard 2005: steps across borders of visibility", "border_step", "luma",
               steps);
  add_measured(result, "Naive Reinhard 2005: border region of the image against the rest",
               "border_region_difference", "luma", regions);
  const auto uncertainty = [](const SceneNumbers& scene) {
    return uncertainty_over(scene.views, "views within the cells", kViewsInCell);
  };
  const std::string how =
      "Beyond what the joint variant shows in the same view, whose one curve treats all key views alike.";
  add_claim(
      result,
      {"A-T5a", "Altmeier 2018, section 6.2.1",
       "With a stable highlight (Dominoes) naive Reinhard 2005 is free of visible steps inside a view."},
      {naive[0].step,
       Comparison::kBelow,
       kSmallestStep,
       "border_step",
       "luma",
       uncertainty(naive[0]),
       {"dominoes"},
       how});
  add_claim(
      result,
      {"A-T5b", "Altmeier 2018, section 6.2.1",
       "With gradual change of light (Dunes) naive Reinhard 2005 is free of visible steps inside a view."},
      {naive[1].step,
       Comparison::kBelow,
       kSmallestStep,
       "border_step",
       "luma",
       uncertainty(naive[1]),
       {"dunes"},
       how});
  add_claim(result,
            {"A-T5c", "Altmeier 2018, section 6.2.1, figure 40",
             "In the Dunes the border region of the image differs visibly from the rest."},
            {naive[1].region,
             Comparison::kAbove,
             kSmallestStep,
             "border_region_difference",
             "luma",
             uncertainty_over(naive[1].views_near_key_views, "views near key views", kViewsOfBorders),
             {"dunes"},
             how + " Views a tenth of a spacing from key views, where the thesis finds it strongest; a first "
                   "version looked at views inside the cells."});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
