#include "analysis/psychophysics/observer.h"

#include <algorithm>

#include "analysis/psychophysics/binomial.h"

namespace plenolab {

std::optional<PositionBias> position_bias(const std::vector<StudyTrial>& trials, double confidence) {
  if (trials.empty()) return std::nullopt;
  const auto left =
      std::count_if(trials.begin(), trials.end(), [](const StudyTrial& t) { return t.chose_left(); });
  const Proportion count{left, static_cast<std::int64_t>(trials.size())};
  return PositionBias{{count, clopper_pearson(count, confidence)},
                      two_sided_p(count.hits, count.trials, 0.5)};
}

std::optional<LapseEstimate> lapse_rate(const std::vector<StudyTrial>& trials, double confidence) {
  Proportion wrong;
  for (const StudyTrial& trial : trials) {
    if (!trial.is_catch) continue;
    ++wrong.trials;
    wrong.hits += trial.chose_test ? 1 : 0;
  }
  if (wrong.trials == 0) return std::nullopt;
  const Interval rate = clopper_pearson(wrong, confidence);
  const auto doubled = [](double value) { return std::min(1.0, 2 * value); };
  return LapseEstimate{{wrong, rate}, {doubled(rate.estimate), doubled(rate.low), doubled(rate.high)}};
}

}  // namespace plenolab
