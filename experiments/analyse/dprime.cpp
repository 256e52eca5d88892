#include "analysis/psychophysics/dprime.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "experiments/analyse/analyse.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

struct DprimeOptions {
  CommonOptions common;
  std::string correct, hits, false_alarms;
  bool raw = false;
  double confidence = 0.95;
};

struct NamedModel {
  const char* name;
  DprimeModel model;
};
constexpr NamedModel kModels[] = {{"2afc", DprimeModel::kTwoAlternatives},
                                  {"abx-independent", DprimeModel::kAbxIndependent},
                                  {"abx-differencing", DprimeModel::kAbxDifferencing}};

void add_interval(ResultTable& table, const Interval& interval, const std::string& model) {
  const std::vector<std::pair<std::string, Cell>> columns{{"model", model}};
  table.add({"dprime", interval.estimate, "1", columns});
  table.add({"dprime_low", interval.low, "1", columns});
  table.add({"dprime_high", interval.high, "1", columns});
}

void add_correct(ResultTable& table, const DprimeOptions& options) {
  const Proportion correct = parse_count(options.correct, "--correct");
  for (const NamedModel& one : kModels)
    add_interval(table, dprime_interval(correct, one.model, !options.raw, options.confidence), one.name);
}

/// The matching models know no share of correct answers below one half.
void warn_below_chance(const DprimeOptions& options) {
  const Proportion correct = parse_count(options.correct, "--correct");
  if (2 * correct.hits >= correct.trials) return;
  fmt::print(
      "Careful: {} of {} correct are fewer than guessing gives. The models of matching to sample (abx) end "
      "at "
      "d' = 0, so that their 0, with its interval, is a limit of the model and no measurement.\n",
      correct.hits, correct.trials);
}

void add_yes_no(ResultTable& table, const DprimeOptions& options) {
  const YesNoSensitivity s = yes_no_sensitivity(parse_count(options.hits, "--hits"),
                                                parse_count(options.false_alarms, "--false-alarms"),
                                                !options.raw, options.confidence);
  add_interval(table, s.dprime, "yes-no");
  table.add({"criterion", s.criterion, "1", {{"model", "yes-no"}}});
  for (const NamedModel& one : kModels)
    if (one.model != DprimeModel::kTwoAlternatives)
      table.add({"dprime", dprime_of(s.unbiased_share, one.model), "1", {{"model", one.name}}});
}

void run_dprime(const Invocation& invocation, const DprimeOptions& options) {
  const bool yes_no = !options.hits.empty() || !options.false_alarms.empty();
  if (yes_no == !options.correct.empty() || options.hits.empty() != options.false_alarms.empty())
    throw UsageError("give either --correct, or --hits and --false-alarms");
  Provenance provenance = begin_run(invocation, options.common);
  ResultTable table;
  if (yes_no)
    add_yes_no(table, options);
  else
    add_correct(table, options);
  emit_results(table, provenance, options.common);
  if (!yes_no && !output_is_for_programs(options.common)) warn_below_chance(options);
}

}  // namespace

void add_analyse_dprime(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<DprimeOptions>();
  app.add_option("--correct", options->correct,
                 "Correct answers as K,N: d' of 2AFC and of matching to sample (ABX)");
  app.add_option("--hits", options->hits, "Hits as K,N of the signal trials: d' of yes/no");
  app.add_option("--false-alarms", options->false_alarms, "False alarms as K,N of the noise trials");
  app.add_flag("--raw", options->raw, "Without the log-linear correction (K + 0.5)/(N + 1)");
  app.add_option("--confidence", options->confidence, "Of the intervals")
      ->capture_default_str()
      ->check(number_between(0.5, 0.999999));
  add_common_options(app, options->common);
  app.footer("Example: plenolab analyse dprime --correct 28,34");
  app.callback([options, &invocation] { run_dprime(invocation, *options); });
}

}  // namespace plenolab
