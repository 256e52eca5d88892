// Z-2 and Z-3: does the content adaptive metric tune tone mapping better?
#include <fmt/format.h>

#include <algorithm>

#include "experiments/reproduce/optimisation/tuning_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_z2(Laboratory& laboratory);
ReproductionResult reproduce_claim_z3(Laboratory& laboratory);

namespace {

using enum TuningMethod;

/// "Every" scene cannot be confirmed by ten of them, but refuted: taken as more than this share.
constexpr double kEvery = 0.95;

const std::vector<GameLight>& harder_lights() {
  static const std::vector<GameLight> lights{GameLight::kDarkHighContrast, GameLight::kDarkLowContrast,
                                             GameLight::kBrightHighContrast};
  return lights;
}

double total_of(const TunedFrame& frame) {
  return frame.total();
}

Plot difference_plot(const std::vector<TunedSequence>& tuned, const FrameValue& value,
                     const std::string& title, const std::string& unit) {
  Plot plot;
  plot.y = {.title = title, .unit = unit};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 980;
  plot.height_px = 480;
  for (const TunedSequence& t : tuned)
    plot.categories.emplace_back(t.sequence->title + std::string("after ").size());
  for (const TuningMethod other : {kGao, kContentAdaptive}) {
    PlotSeries series{fmt::format("less that by {}", name_of(other)), PlotSeries::Style::kPoints, {}};
    for (const double d : sequence_differences(tuned, kZhao, other, value)) series.points.push_back({.y = d});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// A statement on every one of the sequences of some lights, of which `times` are as it says.
Outcome conclude_every(ReproductionResult& result, Claim claim, std::size_t times, std::size_t sequences,
                       const std::string& quantity, const std::string& what) {
  Verdict verdict = decide_claim(share_interval(times, sequences), Comparison::kAbove, kEvery, quantity, "1",
                                 fmt::format("95 % Wilson interval over {} sequences", sequences));
  verdict.scenes = {fmt::format("{} game-like sequences", sequences)};
  verdict.explanation = fmt::format("{} in {} of {} sequences; 'every' is taken as more than {:.0f} %.", what,
                                    times, sequences, 100 * kEvery);
  const Outcome outcome = verdict.outcome;
  conclude(result, std::move(claim), std::move(verdict));
  return outcome;
}

std::string judged_text(const OptimisationBench& bench) {
  return fmt::format("Difference of the means of each sequence ({}).", bench.setting_text());
}

/// One of the statements of Z-2, on the totals of table 2 or one of their parts.
struct Part {
  const char *id, *statement, *quantity;
  TuningMethod other;
  FrameValue value;
  std::vector<GameLight> lights;
  Comparison comparison;
};

std::vector<Part> parts_of_z2() {
  const auto loss = [](const TunedFrame& f) { return f.loss; };
  const auto amplification = [](const TunedFrame& f) { return f.amplification; };
  const auto reversal = [](const TunedFrame& f) { return f.reversal; };
  return {
      {"Z-2a",
       "Optimised by the content adaptive metric, DRIM distortion is lower than by Gao's metric.",
       "drim_total_less_gao",
       kGao,
       total_of,
       {},
       Comparison::kBelow},
      {"Z-2b",
       "On average over all but bright scenes of low contrast it is lower than with content adaptive "
       "defaults.",
       "drim_total_less_content_adaptive", kContentAdaptive, total_of, harder_lights(), Comparison::kBelow},
      {"Z-2c",
       "In bright scenes of low contrast, content adaptive defaults have less distortion.",
       "drim_total_less_content_adaptive_bright_low",
       kContentAdaptive,
       total_of,
       {GameLight::kBrightLowContrast},
       Comparison::kAbove},
      {"Z-2d",
       "Loss of visible contrast falls against Gao's metric.",
       "drim_loss_less_gao",
       kGao,
       loss,
       {},
       Comparison::kBelow},
      {"Z-2e",
       "Amplification of invisible contrast falls against Gao's metric.",
       "drim_amplification_less_gao",
       kGao,
       amplification,
       {},
       Comparison::kBelow},
      {"Z-2f",
       "Reversal of contrast rises against Gao's metric.",
       "drim_reversal_less_gao",
       kGao,
       reversal,
       {},
       Comparison::kAbove},
      {"Z-2g",
       "Fewer pixels are marked by DRIM than by Gao's metric (figure 15).",
       "drim_marked_less_gao",
       kGao,
       [](const TunedFrame& f) { return f.marked; },
       {},
       Comparison::kBelow}};
}

/// Mean of a parameter over all searches of a method.
double mean_parameter(const std::vector<TunedSequence>& tuned, TuningMethod method,
                      double GenericOptions::*parameter) {
  double sum = 0;
  for (const TunedSequence& t : tuned)
    sum +=
        t.mean_of(method, [&](const TunedFrame& f) { return f.parameters ? (*f.parameters).*parameter : 0; });
  return sum / static_cast<double>(tuned.size());
}

/// Where the searches end: what the metrics ask for.
std::string ends_text(const std::vector<TunedSequence>& tuned, TuningMethod method) {
  return fmt::format("c = {:.2f}, m₁ = {:.2f}, m₂ = {:.2f}, m₃ = {:.2f}",
                     mean_parameter(tuned, method, &GenericOptions::contrast),
                     mean_parameter(tuned, method, &GenericOptions::fine),
                     mean_parameter(tuned, method, &GenericOptions::middle),
                     mean_parameter(tuned, method, &GenericOptions::coarse));
}

/// Number of sequences in which the thesis' method has the lowest value of all three.
std::size_t times_lowest(const std::vector<TunedSequence>& tuned, const FrameValue& value) {
  const auto gao = sequence_differences(tuned, kZhao, kGao, value),
             adaptive = sequence_differences(tuned, kZhao, kContentAdaptive, value);
  std::size_t times = 0;
  for (std::size_t i = 0; i < gao.size(); ++i) times += gao[i] < 0 && adaptive[i] < 0 ? 1 : 0;
  return times;
}

}  // namespace

ReproductionResult reproduce_claim_z2(Laboratory& laboratory) {
  ReproductionResult result;
  OptimisationBench& bench = laboratory.optimisation_bench();
  const std::vector<TunedSequence>& tuned = bench.tuned();
  const std::uint64_t seed = laboratory.options().seed;
  std::string found, outcomes;
  for (const Part& part : parts_of_z2()) {
    const std::vector<double> differences =
        sequence_differences(tuned, kZhao, part.other, part.value, part.lights);
    const Interval interval = over_sequences(differences, seed);
    const Outcome outcome =
        conclude_over_sequences(result,
                                {{part.id, tuning_thesis("section 3.2"), part.statement},
                                 part.comparison,
                                 0,
                                 part.quantity,
                                 "%",
                                 fmt::format("{} over {} sequences. {}", interval_text(interval),
                                             differences.size(), judged_text(bench))},
                                differences, seed);
    found += fmt::format("{}{} {}", found.empty() ? "" : ", ", part.id, interval_text(interval));
    outcomes += fmt::format("{}{} {}", outcomes.empty() ? "" : ", ", part.id, outcome_name(outcome));
  }
  const std::vector<double> harder =
      sequence_differences(tuned, kZhao, kContentAdaptive, total_of, harder_lights());
  const auto lower = static_cast<std::size_t>(
      std::count_if(harder.begin(), harder.end(), [](double difference) { return difference < 0; }));
  outcomes += fmt::format(
      ", Z-2h {}",
      outcome_name(conclude_every(result,
                                  {"Z-2h", tuning_thesis("section 3.2"),
                                   "It is lower than with content adaptive defaults in every scene that is "
                                   "not bright and of low contrast."},
                                  lower, harder.size(), "share_of_sequences_with_less_drim", "Lower")));
  result.paper_shows =
      "Section 3.2: parameters optimised by the content adaptive metric give less DRIM distortion than Gao's "
      "metric and content adaptive defaults, but in bright scenes of low contrast; loss and amplification "
      "fall, reversal rises a little.";
  result.ours_shows = fmt::format(
      "Thesis' method less the other, in percentage points of mean probability (Z-2g: of pixels): {}.",
      found);
  const bool more_contrast = mean_parameter(tuned, kZhao, &GenericOptions::contrast) >
                             mean_parameter(tuned, kGao, &GenericOptions::contrast);
  result.differs = fmt::format(
      "{}. Searches by the thesis' metric end at {} on average, those by Gao's at {}{}. Sequences, viewing "
      "conditions and the open choices of both metrics are ours; printed table and text contradict each "
      "other about bright scenes of low contrast (zhao-audit-table-2).",
      outcomes, ends_text(tuned, kZhao), ends_text(tuned, kGao),
      more_contrast
          ? ": the detail feature asks for the contrast of the photographs and never objects to more"
          : "");
  result.add_plot("differences",
                  {difference_plot(tuned, total_of, "Total distortion by Zhao's metric, less the other", "%"),
                   "Total DRIM distortion of the thesis' method less that of the others",
                   "Below 0 the thesis' method is better."});
  return result;
}

ReproductionResult reproduce_claim_z3(Laboratory& laboratory) {
  ReproductionResult result;
  OptimisationBench& bench = laboratory.optimisation_bench();
  const std::vector<TunedSequence>& tuned = bench.tuned();
  const std::uint64_t seed = laboratory.options().seed;
  const FrameValue score = [](const TunedFrame& frame) { return frame.score; };
  const std::string where = tuning_thesis("section 3.2");
  std::string found, outcomes;
  const auto decide = [&](const char* id, TuningMethod other, const char* statement, const char* quantity) {
    const std::vector<double> differences = sequence_differences(tuned, kZhao, other, score);
    const Outcome outcome = conclude_over_sequences(
        result, {{id, where, statement}, Comparison::kBelow, 0, quantity, "1", judged_text(bench)},
        differences, seed);
    found += fmt::format("{} less {}, ", interval_text(over_sequences(differences, seed)), name_of(other));
    outcomes += fmt::format("{} {}, ", id, outcome_name(outcome));
  };
  decide("Z-3a", kGao, "The no-reference score is better than by Gao's metric.", "score_less_gao");
  decide("Z-3b", kContentAdaptive, "The no-reference score is better than with content adaptive defaults.",
         "score_less_content_adaptive");
  const std::size_t times = times_lowest(tuned, score);
  outcomes += fmt::format(
      "Z-3c {}",
      outcome_name(conclude_every(
          result, {"Z-3c", where, "The no-reference score is the best of the three in every scene."}, times,
          tuned.size(), "share_of_sequences_with_best_score", "Best of the three")));
  result.paper_shows =
      "Section 3.2: results have a smaller BRISQUE than the other results, in every scene by the text.";
  result.ours_shows = fmt::format(
      "Thesis' method, mean difference of our no-reference score: {}best of three in {} "
      "of {} sequences.",
      found, times, tuned.size());
  result.differs = fmt::format(
      "{}. The score is our own regressor and not the published BRISQUE; the paper's own figure 15 "
      "contradicts 'every' in one scene.",
      outcomes);
  result.add_plot("score-differences",
                  {difference_plot(tuned, score, "Score by Zhao's metric, less the other", "1"),
                   "No-reference score of the thesis' method less that of the others",
                   "Below 0 the thesis' method is better."});
  return result;
}

}  // namespace plenolab
