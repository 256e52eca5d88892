#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <set>

#include "analysis/psychophysics/study_table.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/analyse/analyse.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/wide_table.h"

namespace plenolab {

namespace {

struct TableOptions {
  CommonOptions common;
  TestOptions test;
  std::string file, mode = "real", interval = "clopper-pearson", plot;
  double confidence = 0.95, most_lapses = StudyOptions{}.most_lapses;
};

TrialMode mode_of(const std::string& word) {
  if (word == "pilot") return TrialMode::kPilot;
  if (word == "simulated") return TrialMode::kSimulated;
  return word == "all" ? TrialMode::kAll : TrialMode::kReal;
}

StudyOptions study_options(const TableOptions& options) {
  StudyOptions study;
  study.p_null = options.test.rate;
  study.alpha = options.test.alpha;
  study.confidence = options.confidence;
  study.most_lapses = options.most_lapses;
  study.seed = options.common.seed;
  study.interval = options.interval == "wilson"     ? IntervalMethod::kWilson
                   : options.interval == "jeffreys" ? IntervalMethod::kJeffreys
                                                    : IntervalMethod::kClopperPearson;
  study.equivalence.margin = options.test.margin;
  study.equivalence.alpha = options.test.alpha;
  study.alternatives = parse_numbers(options.test.true_rates, "--true-rate", 0, 1);
  return study;
}

std::vector<WideColumn> columns_for_people(const Study& study) {
  std::vector<WideColumn> columns{{"trials", "n"},
                                  {"chose_test", "k"},
                                  {"chose_test_rate", "rate"},
                                  {"chose_test_rate_low", "from"},
                                  {"chose_test_rate_high", "to"},
                                  {"critical_number", "to pass"},
                                  {"p_value", "p"},
                                  {"p_holm", "Holm"},
                                  {"p_benjamini_hochberg", "BH"},
                                  {"equivalence_p", "TOST p"},
                                  {"equivalence_p_holm", "TOST Holm"}};
  if (!study.observers.empty()) columns.push_back({"choice_left_rate", "chose left"});
  return columns;
}

std::string printed(const StudyRow& row) {
  const std::string& word = row.count.printed_verdict;
  if (word.empty()) return "";
  const bool agrees = (word == "PASSED") == row.passed;
  return fmt::format(" Printed: {}{}", word, agrees ? "." : ", which the count contradicts.");
}

std::string observer_text(const ObserverSummary& observer, double alpha) {
  std::string text = observer.display.empty() ? "All displays:" : observer.display + ":";
  if (observer.bias)
    text += fmt::format(
        " the left image was chosen in {:.1f} % ({:.1f} … {:.1f} %) of {} trials (p = {} for 50 %)",
        100 * observer.bias->left.interval.estimate, 100 * observer.bias->left.interval.low,
        100 * observer.bias->left.interval.high, observer.bias->left.count.trials,
        format_number(observer.bias->p_value, 3));
  if (observer.lapse)
    text +=
        fmt::format("; {} of {} catch trials were wrong: lapses in {:.1f} % ({:.1f} … {:.1f} %) of trials",
                    observer.lapse->wrong.count.hits, observer.lapse->wrong.count.trials,
                    100 * observer.lapse->lapse.estimate, 100 * observer.lapse->lapse.low,
                    100 * observer.lapse->lapse.high);
  else
    text += "; there were no catch trials, so lapses are not known";
  text += ".";
  if (observer.lapse && observer.lapse->wrong.count.hits > 0 && observer.bias &&
      observer.bias->p_value < alpha)
    text +=
        " Who prefers a side errs in catch trials too: some of what counts as lapses may be that preference.";
  return text;
}

std::string repeats_text(const StudyRow& row) {
  const BetaBinomialFit& fit = row.repeats->fit;
  const std::string image = row.count.display + " " + row.count.image;
  if (!fit.identified) return image + ": all answers were the same, so how alike they are is not known.";
  const auto trials = static_cast<double>(row.count.chose_test.trials);
  return fmt::format(
      "{}: trials of one participant correlate with ρ = {:.3f} ({:.3f} … {:.3f}); the {} trials count like "
      "{:.0f} independent ones.",
      image, fit.overdispersion.estimate, fit.overdispersion.low, fit.overdispersion.high,
      row.count.chose_test.trials, trials / fit.design_effect);
}

void warn_of_repeated_trials(const Study& study) {
  if (std::none_of(study.rows.begin(), study.rows.end(), [](const StudyRow& row) { return row.repeated(); }))
    return;
  fmt::print(
      "Careful: some participants have several trials of one image. They are not independent, so tests and "
      "intervals of that image are too sure:\n");
  for (const StudyRow& row : study.rows)
    if (row.repeats) fmt::print("{}\n", repeats_text(row));
}

std::string participants_text(const ObserverSummary& observer, double alpha) {
  const ParticipantEffect& effect = *observer.participants;
  return fmt::format(
      "{} participants {} (given the rate of each image, two trials of one participant correlate with "
      "{:.3f}, "
      "{:.3f} … {:.3f}; p = {} for none).",
      observer.display.empty() ? "All displays:" : observer.display + ":",
      effect.p_value < alpha ? "differ" : "are not shown to differ", effect.correlation.estimate,
      effect.correlation.low, effect.correlation.high, format_number(effect.p_value, 3));
}

/// Once for each number of trials: power depends on nothing else of a row.
void print_power(const Study& study) {
  std::set<std::int64_t> said;
  for (const StudyRow& row : study.rows) {
    if (!said.insert(row.count.chose_test.trials).second) continue;
    for (std::size_t i = 0; i < row.power.size(); ++i)
      fmt::print("Power of {} trials: an image whose true rate is {:g} passes with probability {:.3f}.\n",
                 row.count.chose_test.trials, study.options.alternatives[i], row.power[i]);
  }
}

/// Whether the same is to be said about the equivalence of all rows.
bool one_equivalence_text(const Study& study) {
  const std::string first = equivalence_text(study.rows.front(), study.options.equivalence);
  return std::all_of(study.rows.begin(), study.rows.end(), [&](const StudyRow& row) {
    return equivalence_text(row, study.options.equivalence) == first;
  });
}

void print_verdicts(const Study& study) {
  const bool once = one_equivalence_text(study);
  for (const StudyRow& row : study.rows)
    fmt::print("{} {}: {}{}\n", row.count.display, row.count.image,
               once ? pass_text(row, study.options) + "." : verdict_text(row, study.options), printed(row));
  fmt::print("\nPassing means only that a rate of {:g} is refuted (p < {:g}, each row by itself).\n",
             study.options.p_null, study.options.alpha);
  if (once) fmt::print("Equivalence: {}.\n", equivalence_text(study.rows.front(), study.options.equivalence));
}

void print_for_people(const Study& study, const ResultTable& table) {
  fmt::print("{}\n", to_wide_text(table, {"display", "image"}, columns_for_people(study)));
  print_verdicts(study);
  warn_of_repeated_trials(study);
  print_power(study);
  fmt::print(
      "If every true rate were {:g}, at least one of the {} rows would pass with probability {:.3f}.\n",
      study.options.p_null, study.rows.size(), study.any_false_pass);
  for (const ObserverSummary& observer : study.observers)
    fmt::print("{}\n", observer_text(observer, study.options.alpha));
  for (const ObserverSummary& observer : study.observers)
    if (observer.participants) fmt::print("{}\n", participants_text(observer, study.options.alpha));
}

void run_table(const Invocation& invocation, const TableOptions& options, bool mode_given) {
  const StudyOptions study_with = study_options(options);
  Provenance provenance = begin_run(invocation, options.common);
  const CsvTable csv = parse_csv(read_text_file(options.file), options.file);
  add_input(provenance, options.file);
  if (mode_given && !holds_trials(csv))
    throw UsageError(fmt::format("--mode is for trials; {} holds counts", options.file));
  Study study;
  ResultTable table;
  if (holds_trials(csv)) {
    const auto trials = trials_of_mode(parse_study_trials(csv), mode_of(options.mode));
    study = analyse_trials(trials, study_with);
  } else {
    study = analyse_counts(parse_study_counts(csv), study_with);
  }
  table = study_table(study);
  if (!output_is_for_programs(options.common)) print_for_people(study, table);
  write_results(table, provenance, options.common);
  if (!options.plot.empty()) write_plot_as(options.plot, study_plot(study), options.common);
}

}  // namespace

void add_analyse_table(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<TableOptions>();
  app.add_option("file", options->file,
                 "Counts (columns display, image, n, k and, if known, verdict), or trials.csv of sessions")
      ->required();
  CLI::Option* mode =
      app.add_option("--mode", options->mode, "Whose trials count: real, pilot, simulated or all")
          ->capture_default_str()
          ->check(one_of({"real", "pilot", "simulated", "all"}));
  add_test_options(app, options->test);
  app.add_option("--confidence", options->confidence, "Of the intervals")
      ->capture_default_str()
      ->check(number_between(0.5, 0.999999));
  app.add_option("--interval", options->interval, "Of the rates: clopper-pearson (exact), wilson or jeffreys")
      ->capture_default_str()
      ->check(one_of({"clopper-pearson", "wilson", "jeffreys"}));
  app.add_option("--most-lapses", options->most_lapses,
                 "Largest upper end of the share of lapses with which images may be called indistinguishable")
      ->capture_default_str()
      ->check(number_between(0, 1));
  add_plot_option(app, options->plot);
  add_common_options(app, options->common);
  app.footer("Example: plenolab analyse table counts.csv --plot results/choices");
  app.callback([options, mode, &invocation] { run_table(invocation, *options, mode->count() > 0); });
}

}  // namespace plenolab
