#include "experiments/reproduce/optimisation/tuning_tools.h"

#include <algorithm>

namespace plenolab {

std::string tuning_thesis(const std::string& where) {
  return "Zhao 2019, " + where;
}

std::vector<double> sequence_differences(const std::vector<TunedSequence>& tuned, TuningMethod a,
                                         TuningMethod b, const FrameValue& value,
                                         const std::vector<GameLight>& lights) {
  std::vector<double> differences;
  for (const TunedSequence& t : tuned)
    if (lights.empty() || std::find(lights.begin(), lights.end(), t.sequence->light) != lights.end())
      differences.push_back(t.mean_of(a, value) - t.mean_of(b, value));
  return differences;
}

Interval over_sequences(const std::vector<double>& values, std::uint64_t seed) {
  constexpr double kUnknown = 1e9;
  return mean_interval(values, seed).value_or(Interval{mean(values), -kUnknown, kUnknown});
}

Outcome conclude_over_sequences(ReproductionResult& result, const SequenceClaim& claim,
                                const std::vector<double>& values, std::uint64_t seed) {
  Verdict verdict = decide_claim(over_sequences(values, seed), claim.comparison, claim.threshold,
                                 claim.quantity, claim.unit, uncertainty_over(values.size(), "sequences"));
  verdict.scenes = {std::to_string(values.size()) + " game-like sequences"};
  verdict.explanation = claim.explanation;
  const Outcome outcome = verdict.outcome;
  conclude(result, claim.claim, std::move(verdict));
  return outcome;
}

TuningMethod lowest_of(const std::array<double, 3>& by_method) {
  return kTuningMethods[static_cast<std::size_t>(std::min_element(by_method.begin(), by_method.end()) -
                                                 by_method.begin())];
}

}  // namespace plenolab
