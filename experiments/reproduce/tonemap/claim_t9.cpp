// A-T9, thesis section 6.2.2: in the Cellar the naive variant starts to adapt before the light changes; the
// interpolating one adapts at the event.
#include <fmt/format.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/claim_tools.h"
#include "experiments/reproduce/tonemap/motion_measures.h"

namespace plenolab {

ReproductionResult reproduce_claim_t9(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "cellar";

/// Lead times of all lines where the light source appears or is hidden.
std::vector<double> leads(MappingBench& bench, Shown shown) {
  const Mapping mapping = mapping_for(bench, kScene, shown);
  std::vector<double> values;
  for (int line = 0; line < kMotionLines; ++line) {
    const RecordedMotion& recording = bench.recording(kScene, line);
    const int window = recording.motion.frames / 4;  // a spacing of five columns
    if (const auto lead =
            lead_time_s(recording, adaptation_track(bench.motion(kScene, mapping, line)), window))
      values.push_back(*lead);
  }
  return values;
}

}  // namespace

ReproductionResult reproduce_claim_t9(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  const std::uint64_t seed = laboratory.options().seed;
  std::vector<MeasuredNumber> numbers;
  for (const Shown shown : {Shown::kReinhardNaive, Shown::kReinhardStatistics, Shown::kReinhardResults,
                            Shown::kReinhardAdjusted, Shown::kRobust})
    numbers.push_back({mapping_for(bench, kScene, shown).label, mean_interval(leads(bench, shown), seed)});
  const double frame = 1 / Motion{}.frames_per_second;
  result.paper_shows =
      "Section 6.2.2 and figure 43: when the timber hides the sun, the statistic-interpolating variant "
      "adapts "
      "rapidly and at that moment; the naive one gradually, beginning before the light changes, because key "
      "views fade in and out.";
  result.ours_shows = fmt::format(
      "Time by which a tenth of the change of brightness precedes the moment at which the sun appears or is "
      "hidden: naive {} s, statistics interpolated {} s, results interpolated {} s, robust {} s (mean over "
      "the lines "
      "of motion where a mapping changes visibly). A frame lasts {:.3f} s.",
      text_of(numbers[0].interval), text_of(numbers[1].interval), text_of(numbers[2].interval),
      text_of(numbers[4].interval), frame);
  add_measured(result, "Lead of the change of brightness before the event, Cellar", "lead", "s", numbers);
  const std::string uncertainty = "95 % bootstrap over lines of motion",
                    how = "A tenth of the change within one spacing before to one after the event.";
  add_claim(result,
            {"A-T9a", "Altmeier 2018, section 6.2.2, figure 43",
             "In the Cellar the naive variant starts to adapt before the light changes."},
            {numbers[0].interval, Comparison::kAbove, frame, "lead", "s", uncertainty, {kScene}, how});
  add_claim(result,
            {"A-T9b", "Altmeier 2018, section 6.2.2, figure 43",
             "In the Cellar the statistic-interpolating variant adapts at the event."},
            {numbers[1].interval, Comparison::kBelow, frame, "lead", "s", uncertainty, {kScene}, how});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
