#include "analysis/psychophysics/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/dprime.h"
#include "analysis/psychophysics/multiplicity.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

using Columns = std::vector<std::pair<std::string, Cell>>;

StudyRow analyse_count(const StudyCount& count, const StudyOptions& options) {
  count.chose_test.validate();
  const auto [hits, trials] = count.chose_test;
  StudyRow row;
  row.count = count;
  row.critical = critical_number(trials, options.p_null, options.alpha);
  row.passed = hits >= row.critical;
  const double log_p = log_upper_tail(hits, trials, options.p_null);
  row.p_value = std::exp(log_p);
  row.log10_p = log_p / std::numbers::ln10;
  row.rate = rate_interval(count.chose_test, options.interval, options.confidence);
  row.posterior_above_null = posterior_above(count.chose_test, options.p_null);
  for (const double p : options.alternatives) row.power.push_back(upper_tail(row.critical, trials, p));
  row.equivalence_p = equivalence_p(count.chose_test, options.equivalence);
  row.equivalence = equivalence_region(trials, options.equivalence);
  return row;
}

void adjust_p_values(Study& study) {
  std::vector<double> p_values, equivalence_p_values;
  double log_none = 0;
  for (const StudyRow& row : study.rows) {
    p_values.push_back(row.p_value);
    equivalence_p_values.push_back(row.equivalence_p);
    log_none += std::log1p(-upper_tail(row.critical, row.count.chose_test.trials, study.options.p_null));
  }
  const std::vector<double> by_holm = holm(p_values), by_bh = benjamini_hochberg(p_values);
  const std::vector<double> equivalence_by_holm = holm(equivalence_p_values);
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    study.rows[i].p_holm = by_holm[i];
    study.rows[i].p_bh = by_bh[i];
    study.rows[i].equivalence_p_holm = equivalence_by_holm[i];
  }
  study.any_false_pass = std::abs(std::expm1(log_none));  // no negative zero where no count passes
}

template <class Keep>
std::vector<StudyTrial> those(const std::vector<StudyTrial>& trials, const Keep& keep) {
  std::vector<StudyTrial> kept;
  for (const StudyTrial& trial : trials)
    if (keep(trial)) kept.push_back(trial);
  return kept;
}

ObserverSummary summarise(const std::string& display, const std::vector<StudyTrial>& trials,
                          const StudyOptions& options) {
  return {display, position_bias(trials, options.confidence), lapse_rate(trials, options.confidence),
          participant_effect(trials, {.confidence = options.confidence, .seed = options.seed})};
}

void add_observers(Study& study, const std::vector<StudyTrial>& trials) {
  std::set<std::string> seen;
  for (const StudyTrial& trial : trials)
    if (seen.insert(trial.display).second)
      study.observers.push_back(summarise(
          trial.display, those(trials, [&](const StudyTrial& t) { return t.display == trial.display; }),
          study.options));
  study.observers.push_back(summarise("", trials, study.options));
}

RepeatedTrials repeated_trials(const std::vector<StudyTrial>& of_image, const StudyOptions& options) {
  std::map<std::string, Proportion> counts;
  for (const StudyTrial& trial : of_image) {
    Proportion& count = counts[trial.participant];
    ++count.trials;
    count.hits += trial.chose_test ? 1 : 0;
  }
  std::vector<Proportion> participants;
  for (const auto& entry : counts) participants.push_back(entry.second);
  return {fit_beta_binomial(participants, options.confidence),
          beta_binomial_posterior_above(participants, options.p_null)};
}

/// Why trials on a display with these lapses do not show that images look the same; empty if they may.
std::string doubt_of_attention(const std::optional<LapseEstimate>& lapse, double most_lapses) {
  if (!lapse) return "there were no catch trials, so nobody is known to have looked";
  if (lapse->lapse.high <= most_lapses) return "";
  return fmt::format(
      "{} of {} catch trials were wrong, so participants may have guessed in up to {:.3g} % of trials, more "
      "than {:.3g} %",
      lapse->wrong.count.hits, lapse->wrong.count.trials, 100 * lapse->lapse.high, 100 * most_lapses);
}

/// A rate near 0.5 that is the mean of those who see a difference and those who take the test image for the
/// reference does not show that the images look the same.
std::string doubt_of_likeness(const std::optional<ParticipantEffect>& effect, double alpha) {
  if (!effect || effect->p_value >= alpha) return "";
  return fmt::format(
      "only on average: participants differ on this display (p = {}), and some may see a difference",
      format_number(effect->p_value, 3));
}

std::string doubt(const StudyRow& row, const Study& study) {
  if (row.repeated()) return "participants have several trials of the image, which are not independent";
  const auto observer =
      std::find_if(study.observers.begin(), study.observers.end(),
                   [&](const ObserverSummary& o) { return o.display == row.count.display; });
  const std::string attention = doubt_of_attention(observer->lapse, study.options.most_lapses);
  return attention.empty() ? doubt_of_likeness(observer->participants, study.options.alpha) : attention;
}

void add_interval(ResultTable& table, const std::string& quantity, const Interval& interval,
                  const Columns& columns) {
  table.add({quantity, interval.estimate, "1", columns});
  table.add({quantity + "_low", interval.low, "1", columns});
  table.add({quantity + "_high", interval.high, "1", columns});
}

/// d′ of those who did not take the test image for the reference.
void add_sensitivity(ResultTable& table, const StudyRow& row, const StudyOptions& options, Columns columns) {
  const auto [hits, trials] = row.count.chose_test;
  columns.emplace_back("model", "");
  for (const auto& [name, model] : {std::pair{"abx-independent", DprimeModel::kAbxIndependent},
                                    std::pair{"abx-differencing", DprimeModel::kAbxDifferencing}}) {
    columns.back().second = std::string(name);
    add_interval(table, "dprime", dprime_interval({trials - hits, trials}, model, true, options.confidence),
                 columns);
  }
}

void add_repeats(ResultTable& table, const RepeatedTrials& repeats, const Columns& columns) {
  if (!repeats.fit.identified) return;
  add_interval(table, "overdispersion", repeats.fit.overdispersion, columns);
  table.add({"overdispersion_p", repeats.fit.p_overdispersed, "1", columns});
  table.add({"design_effect", repeats.fit.design_effect, "1", columns});
  add_interval(table, "mean_rate", repeats.fit.rate, columns);
  table.add({"mean_rate_above_null", repeats.rate_above_null, "1", columns});
}

void add_row(ResultTable& table, const StudyRow& row, const StudyOptions& options) {
  Columns columns{{"display", row.count.display}, {"image", row.count.image}};
  if (!row.count.printed_verdict.empty()) columns.emplace_back("printed_verdict", row.count.printed_verdict);
  const auto add = [&](const std::string& quantity, double value) {
    table.add({quantity, value, "1", columns});
  };
  add("trials", static_cast<double>(row.count.chose_test.trials));
  add("chose_test", static_cast<double>(row.count.chose_test.hits));
  if (row.count.participants > 0) add("participants", static_cast<double>(row.count.participants));
  add_interval(table, "chose_test_rate", row.rate, columns);
  add_sensitivity(table, row, options, columns);
  add("critical_number", static_cast<double>(row.critical));
  add("passed", row.passed ? 1 : 0);
  add("p_value", row.p_value);
  add("log10_p", row.log10_p);
  add("p_holm", row.p_holm);
  add("p_benjamini_hochberg", row.p_bh);
  add("posterior_above_null", row.posterior_above_null);
  for (std::size_t i = 0; i < row.power.size(); ++i) {
    Columns with_rate = columns;
    with_rate.emplace_back("true_rate", options.alternatives[i]);
    table.add({"power", row.power[i], "1", with_rate});
  }
  add("equivalence_p", row.equivalence_p);
  add("equivalence_p_holm", row.equivalence_p_holm);
  add("equivalent", row.equivalent() ? 1 : 0);
  add("indistinguishable", row.indistinguishable(options.equivalence) ? 1 : 0);
  if (!row.equivalence.empty()) {
    add("equivalence_low_count", static_cast<double>(row.equivalence.low));
    add("equivalence_high_count", static_cast<double>(row.equivalence.high));
  }
  if (row.bias) {
    add("choice_left_rate", row.bias->left.interval.estimate);
    add("choice_left_p", row.bias->p_value);
  }
  if (row.repeats) add_repeats(table, *row.repeats, columns);
}

void add_observer_rows(ResultTable& table, const ObserverSummary& observer) {
  const Columns columns{{"display", observer.display.empty() ? "all" : observer.display}};
  if (observer.bias) {
    add_interval(table, "observer_left_rate", observer.bias->left.interval, columns);
    table.add({"observer_left_p", observer.bias->p_value, "1", columns});
  }
  if (observer.lapse) {
    table.add({"catch_trials", static_cast<double>(observer.lapse->wrong.count.trials), "1", columns});
    add_interval(table, "catch_wrong_rate", observer.lapse->wrong.interval, columns);
    add_interval(table, "lapse_rate", observer.lapse->lapse, columns);
  }
  if (observer.participants) {
    add_interval(table, "participant_correlation", observer.participants->correlation, columns);
    table.add({"participant_effect_p", observer.participants->p_value, "1", columns});
  }
}

}  // namespace

void StudyOptions::validate() const {
  equivalence.validate();
  if (!(p_null >= 0 && p_null < 1))
    throw InputError(fmt::format("the tested rate is {} but must lie in [0, 1)", p_null));
  if (!(alpha > 0 && alpha < 1)) throw InputError(fmt::format("alpha is {} but must lie in (0, 1)", alpha));
  if (!(confidence > 0 && confidence < 1))
    throw InputError(fmt::format("confidence is {} but must lie in (0, 1)", confidence));
  if (!(most_lapses >= 0 && most_lapses <= 1))
    throw InputError(fmt::format("the largest share of lapses is {} but must lie in [0, 1]", most_lapses));
  for (const double p : alternatives)
    if (!(p >= 0 && p <= 1)) throw InputError(fmt::format("the true rate {} must lie in [0, 1]", p));
}

Study analyse_counts(const std::vector<StudyCount>& counts, const StudyOptions& options) {
  options.validate();
  if (counts.empty()) throw InputError("a study needs at least one image on one display");
  Study study{options, {}, {}, 0};
  for (const StudyCount& count : counts) study.rows.push_back(analyse_count(count, options));
  adjust_p_values(study);
  return study;
}

Study analyse_trials(const std::vector<StudyTrial>& trials, const StudyOptions& options) {
  Study study = analyse_counts(count_choices(trials), options);
  for (StudyRow& row : study.rows) {
    const auto of_image = those(trials, [&](const StudyTrial& t) {
      return !t.is_catch && t.display == row.count.display && t.image == row.count.image;
    });
    row.bias = position_bias(of_image, options.confidence);
    if (row.repeated()) row.repeats = repeated_trials(of_image, options);
  }
  add_observers(study, trials);
  for (StudyRow& row : study.rows) row.withheld = doubt(row, study);
  return study;
}

std::string verdict_word(const StudyRow& row) {
  return row.passed ? "passed" : "failed";
}

std::string equivalence_text(const StudyRow& row, const EquivalenceOptions& options) {
  const std::string margin = fmt::format("{:g} ± {:g}", options.centre, options.margin);
  if (row.equivalence.empty())
    return fmt::format("no count of {} trials could show that the rate lies within {}",
                       row.count.chose_test.trials, margin);
  const std::string p_values = fmt::format("TOST p = {}, Holm {}", format_number(row.equivalence_p, 3),
                                           format_number(row.equivalence_p_holm, 3));
  if (row.indistinguishable(options))
    return fmt::format("indistinguishable within {} ({}){}", margin, p_values,
                       row.count.participants == 0 ? " if observers looked, which counts do not tell" : "");
  if (row.equivalence_p_holm < options.alpha)
    return fmt::format("the rate lies within {} ({}), but {}", margin, p_values, row.withheld);
  if (row.equivalent())
    return fmt::format("that the rate lies within {} is not shown after Holm's correction ({})", margin,
                       p_values);
  return fmt::format("that the rate lies within {} is not shown (it takes {} to {})", margin,
                     row.equivalence.low, row.equivalence.high);
}

std::string pass_text(const StudyRow& row, const StudyOptions& options) {
  const auto [hits, trials] = row.count.chose_test;
  if (row.critical > trials)
    return fmt::format("failed: no count of {} trials can refute a rate of {:g}", trials, options.p_null);
  if (row.passed)
    return fmt::format("passed: {} of {} reach {}, so the rate is above {:g} (p = {})", hits, trials,
                       row.critical, options.p_null, format_number(row.p_value, 3));
  return fmt::format("failed: {} of {} do not reach {}, so a rate of {:g} is not refuted (p = {})", hits,
                     trials, row.critical, options.p_null, format_number(row.p_value, 3));
}

std::string verdict_text(const StudyRow& row, const StudyOptions& options) {
  return pass_text(row, options) + "; " + equivalence_text(row, options.equivalence) + ".";
}

ResultTable study_table(const Study& study) {
  ResultTable table;
  for (const StudyRow& row : study.rows) add_row(table, row, study.options);
  for (const ObserverSummary& observer : study.observers) add_observer_rows(table, observer);
  table.add({"any_false_pass", study.any_false_pass, "1", {}});
  return table;
}

}  // namespace plenolab
