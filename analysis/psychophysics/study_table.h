#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/plot.h"
#include "analysis/psychophysics/beta_binomial.h"
#include "analysis/psychophysics/equivalence.h"
#include "analysis/psychophysics/observer.h"
#include "analysis/psychophysics/participant_effect.h"
#include "analysis/psychophysics/study_data.h"
#include "analysis/result_table.h"

namespace plenolab {

/// The table of a study: one row for each image on each display, with everything that stands beside "passed"
/// so that nobody reads more into it than it says. From counts or from the trials of sessions.

struct StudyOptions {
  double p_null = 0.19;  ///< rate that a pass refutes, in [0, 1)
  double alpha = 0.05;
  double confidence = 0.95;  ///< of the intervals
  IntervalMethod interval = IntervalMethod::kClopperPearson;
  EquivalenceOptions equivalence;
  /// True rates at which the power is stated; each in [0, 1].
  std::vector<double> alternatives{0.25, 0.5};
  /// Largest upper end of the lapse interval with which answers may be called indistinguishable, in [0, 1].
  /// Who guesses brings a rate nearer to 0.5: with a share λ of lapses, answers within 0.5 ± margin come from
  /// rates within 0.5 ± margin / (1 − λ), at 0.2 a margin wider by a quarter.
  double most_lapses = 0.2;
  std::uint64_t seed = 1;  ///< of what is resampled: intervals and p of ParticipantEffect

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// How far participants differ in their trials of one image.
struct RepeatedTrials {
  BetaBinomialFit fit;
  double rate_above_null = 0;  ///< posterior probability that the mean rate is above p_null
};

struct StudyRow {
  StudyCount count;
  std::int64_t critical = 0;         ///< i_c; trials + 1: no count can pass
  bool passed = false;               ///< hits ≥ i_c, and nothing else
  double p_value = 1;                ///< P(X ≥ hits) at p_null
  double log10_p = 0;                ///< also where p_value underflows; −∞ if the count is impossible
  double p_holm = 1, p_bh = 1;       ///< adjusted over all rows of the study
  Interval rate;                     ///< by options.interval
  double posterior_above_null = 0;   ///< P(rate > p_null | count), uniform prior
  std::vector<double> power;         ///< at the alternatives
  double equivalence_p = 1;          ///< of the exact TOST
  double equivalence_p_holm = 1;     ///< adjusted over all rows of the study
  EquivalenceRegion equivalence;     ///< counts that show equivalence at this number of trials
  std::optional<PositionBias> bias;  ///< of the row's trials; absent for counts
  std::optional<RepeatedTrials> repeats;  ///< where repeated()
  /// Why "indistinguishable" is withheld whatever the test of equivalence says, as a clause; empty if nothing
  /// speaks against it. Counts alone tell nothing of lapses: for them it is empty.
  std::string withheld;

  /// Whether participants have several of the trials: these are not independent, and tests and intervals,
  /// which take them for it, are too sure.
  bool repeated() const { return count.participants > 0 && count.participants < count.chose_test.trials; }
  /// Whether the test of equivalence succeeds for this row by itself.
  bool equivalent() const { return equivalence.contains(count.chose_test.hits); }
  /// Whether it does so after Holm's correction, and observers are known to have looked.
  bool indistinguishable(const EquivalenceOptions& options) const {
    return equivalence_p_holm < options.alpha && withheld.empty();
  }
};

/// Behaviour on one display, or on all (display empty).
struct ObserverSummary {
  std::string display;
  std::optional<PositionBias> bias;
  std::optional<LapseEstimate> lapse;
  std::optional<ParticipantEffect> participants;  ///< given the rates of images; absent if it cannot be told
};

struct Study {
  StudyOptions options;
  std::vector<StudyRow> rows;
  std::vector<ObserverSummary> observers;  ///< displays in order, then all; empty for counts
  double any_false_pass =
      0;  ///< chance that at least one row passes if every true rate is p_null (independent)
};

/// Throws InputError for no counts or options out of range.
Study analyse_counts(const std::vector<StudyCount>& counts, const StudyOptions& options = {});
/// The same from trials; position bias and lapses come with it.
Study analyse_trials(const std::vector<StudyTrial>& trials, const StudyOptions& options = {});

/// What the row says, in one sentence. "Indistinguishable" appears only where indistinguishable() holds;
/// where the test of equivalence succeeded and the word is withheld, the sentence says why.
std::string verdict_text(const StudyRow& row, const StudyOptions& options);
/// Its two halves: what passing or failing says, and what is known about equivalence.
std::string pass_text(const StudyRow& row, const StudyOptions& options);
std::string equivalence_text(const StudyRow& row, const EquivalenceOptions& options);
/// "passed" or "failed".
std::string verdict_word(const StudyRow& row);

/// Long-form rows with the columns display and image: trials, chose_test, chose_test_rate and its _low and
/// _high, dprime (column model, with _low and _high), critical_number, passed (1 or 0), p_value, log10_p,
/// p_holm, p_benjamini_hochberg, posterior_above_null, power (column true_rate), equivalence_p and its _holm,
/// equivalent (1 or 0, the row by itself), indistinguishable (1 or 0), equivalence_low_count and _high_count
/// (absent where no count can), choice_left_rate, choice_left_p; where participants repeat an image and the
/// data can tell, overdispersion and mean_rate (with _low and _high), overdispersion_p, design_effect and
/// mean_rate_above_null. With the column display alone (all displays: "all"): observer_left_rate,
/// observer_left_p, catch_trials, catch_wrong_rate, lapse_rate and participant_correlation, rates with _low
/// and _high, participant_effect_p. any_false_pass for the study. Column printed_verdict where there is one.
ResultTable study_table(const Study& study);

/// Share of choices of the test image by image, a bar for each display with its exact interval, and the line
/// that must be reached to pass. Images that a display lacks have a bar of no height. `counts` draws numbers
/// of participants instead of shares, as the paper does: only if all rows have as many trials.
Plot study_plot(const Study& study, bool counts = false);

}  // namespace plenolab
