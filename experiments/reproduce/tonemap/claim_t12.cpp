// A-T12, thesis section 6.2: in the Dunes key-view adjustment removes artefacts of border regions and lowers
// adaptation; interpolated statistics adapt undesirably fast.
#include <fmt/format.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/claim_tools.h"
#include "experiments/reproduce/tonemap/motion_measures.h"

namespace plenolab {

ReproductionResult reproduce_claim_t12(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "dunes";

}  // namespace

ReproductionResult reproduce_claim_t12(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  const std::uint64_t seed = laboratory.options().seed;
  const Mapping naive = mapping_for(bench, kScene, Shown::kReinhardNaive),
                adjusted = mapping_for(bench, kScene, Shown::kReinhardAdjusted),
                statistics = mapping_for(bench, kScene, Shown::kReinhardStatistics),
                joint = mapping_for(bench, kScene, Shown::kReinhardJoint);
  const auto regions = [&](const Mapping& mapping) {
    return border_regions(
        frame_inconsistencies(bench, kScene, mapping, joint, bench.views_near_key_views(kScene)));
  };
  const std::vector<double> adjusted_regions = regions(adjusted), naive_regions = regions(naive);
  const auto region = mean_ratio(adjusted_regions, naive_regions, seed, kViewsOfBorders);
  const std::vector<double> naive_ranges = adaptation_ranges(bench, kScene, naive);
  const auto range = mean_ratio(adaptation_ranges(bench, kScene, adjusted), naive_ranges, seed);
  const auto step =
      mean_ratio(largest_steps(bench, kScene, statistics), largest_steps(bench, kScene, naive), seed);
  result.paper_shows =
      "Section 6.2, figures 40 and 44: in the Dunes key-view adjustment removes the brighter or darker "
      "border "
      "region that naive Reinhard 2005 shows near key views, and adapts less; with statistics interpolated "
      "the "
      "adaptation is undesirably fast.";
  result.ours_shows = fmt::format(
      "Adjusted over naive: difference of the border region from the rest of the view {}, range of "
      "adaptation "
      "over the motion {}. Largest change of brightness between frames, statistics interpolated over naive: "
      "{}.",
      text_of(region), text_of(range), text_of(step));
  add_measured(result, "Dunes, over naive Reinhard 2005", "over_naive", "1",
               {{"adjusted: border region", region},
                {"adjusted: range of adaptation", range},
                {"statistics interpolated: largest change between frames", step}});
  add_claim(
      result,
      {"A-T12a", "Altmeier 2018, section 6.2.1, figure 40",
       "In the Dunes key-view adjustment lowers differences of the border region."},
      {region,
       Comparison::kBelow,
       1,
       "border_region_ratio",
       "1",
       uncertainty_over(naive_regions.size(), "views near key views", kViewsOfBorders),
       {kScene},
       fmt::format("Adjusted over naive, {:.4f} of luma on average; differences beyond those of the joint "
                   "variant, in views a tenth of a spacing from key views. {}",
                   mean(naive_regions),
                   mean(naive_regions) < kSmallestStep
                       ? "Less than a step of an 8-bit display is there to be lowered."
                       : "")});
  add_claim(
      result,
      {"A-T12b", "Altmeier 2018, section 6.2.2, figure 44",
       "In the Dunes key-view adjustment lowers adaptation."},
      {range,
       Comparison::kBelow,
       1,
       "adaptation_range_ratio",
       "1",
       uncertainty_over(kMotionLines, "lines of motion"),
       {kScene},
       "Range of the brightness of surfaces under unchanged light over the motion, adjusted over naive."});
  add_claim(result,
            {"A-T12c", "Altmeier 2018, section 6.2.2, figure 44",
             "In the Dunes the statistic-interpolating variant adapts faster than the naive one."},
            {step,
             Comparison::kAbove,
             1,
             "largest_frame_step_ratio",
             "1",
             uncertainty_over(kMotionLines, "lines of motion"),
             {kScene},
             "Largest change of brightness from frame to frame, statistics interpolated over naive."});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
