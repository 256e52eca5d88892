// A-T9, thesis section 6.2.2: in the Cellar the naive variant starts to adapt before the light changes; the
// interpolating one adapts at the event.
#include <fmt/format.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/adaptation_pace.h"
#include "experiments/reproduce/tonemap/claim_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_t9(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "cellar";

/// "Starts before": at least a tenth of the change happens before the light changes.
constexpr double kTenth = 0.1;

/// Shares of the change ahead of the event, of all lines of motion that the mapping changes visibly on.
std::vector<double> shares_before(MappingBench& bench, Shown shown) {
  const Mapping mapping = mapping_for(bench, kScene, shown);
  std::vector<double> shares;
  for (int line = 0; line < kMotionLines; ++line) {
    const RecordedMotion& recording = bench.recording(kScene, line);
    const Adaptation adaptation = adaptation_of(adaptation_track(bench.motion(kScene, mapping, line)),
                                                recording.event, frames_per_spacing(recording.motion));
    if (adaptation.share_before && adaptation.range > kSmallestStep)
      shares.push_back(*adaptation.share_before);
  }
  return shares;
}

}  // namespace

ReproductionResult reproduce_claim_t9(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  const std::uint64_t seed = laboratory.options().seed;
  std::vector<MeasuredNumber> numbers;
  std::vector<std::size_t> lines;
  for (const Shown shown : {Shown::kReinhardNaive, Shown::kReinhardStatistics, Shown::kReinhardResults,
                            Shown::kReinhardAdjusted, Shown::kRobust}) {
    const std::vector<double> shares = shares_before(bench, shown);
    numbers.push_back({fmt::format("{}, {} lines", mapping_for(bench, kScene, shown).label, shares.size()),
                       mean_interval(shares, seed)});
    lines.push_back(shares.size());
  }
  result.paper_shows =
      "Section 6.2.2 and figure 43: when the timber hides the sun, the statistic-interpolating variant "
      "adapts "
      "rapidly and at that moment; the naive one gradually, beginning before the light changes, because key "
      "views fade in and out.";
  result.ours_shows = fmt::format(
      "Of all changes of brightness within one spacing of the moment at which the sun appears or is hidden, "
      "this share comes before it (mean over those of {} lines of motion along which brightness changes "
      "visibly): naive {}, statistics interpolated {}, results interpolated {}, robust {}.",
      kMotionLines, text_of(numbers[0].interval), text_of(numbers[1].interval), text_of(numbers[2].interval),
      text_of(numbers[4].interval));
  add_measured(result, "Share of the change of brightness before the event, Cellar", "share_before", "1",
               numbers);
  const auto uncertainty = [&](std::size_t mapping) {
    return uncertainty_over(lines[mapping], "lines of motion that change visibly");
  };
  const std::string how =
      "Sum of the absolute changes of luma from frame to frame, surfaces under unchanged "
      "light, from one spacing before to one after the event. Changed after a first look: a "
      "lead time in seconds cannot tell noise from the beginning of a slow change.";
  add_claim(
      result,
      {"A-T9a", "Altmeier 2018, section 6.2.2, figure 43",
       "In the Cellar the naive variant starts to adapt before the light changes."},
      {numbers[0].interval, Comparison::kAbove, kTenth, "share_before", "1", uncertainty(0), {kScene}, how});
  add_claim(
      result,
      {"A-T9b", "Altmeier 2018, section 6.2.2, figure 43",
       "In the Cellar the statistic-interpolating variant adapts at the event."},
      {numbers[1].interval, Comparison::kBelow, kTenth, "share_before", "1", uncertainty(1), {kScene}, how});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
