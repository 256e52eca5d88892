#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/equivalence.h"
#include "experiments/analyse/analyse.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

struct CriticalOptions {
  CommonOptions common;
  TestOptions test;
  std::int64_t trials = 34;
};

void add_note(ResultTable& table, const std::string& text) {
  table.add({kNoteQuantity, 0, "1", {{"note", text}}});
}

void add_equivalence(ResultTable& table, const CriticalOptions& options) {
  const EquivalenceOptions equivalence{.margin = options.test.margin, .alpha = options.test.alpha};
  const EquivalenceRegion region = equivalence_region(options.trials, equivalence);
  if (region.empty()) {
    add_note(table, fmt::format("no count of {} trials could show that the rate lies within {:g} ± {:g}",
                                options.trials, equivalence.centre, equivalence.margin));
    return;
  }
  table.add({"equivalence_low_count", static_cast<double>(region.low), "1", {}});
  table.add({"equivalence_high_count", static_cast<double>(region.high), "1", {}});
}

void run_critical(const Invocation& invocation, const CriticalOptions& options) {
  const std::vector<double> true_rates = parse_numbers(options.test.true_rates, "--true-rate", 0, 1);
  Provenance provenance = begin_run(invocation, options.common);
  const TestOptions& test = options.test;
  const std::int64_t critical = critical_number(options.trials, test.rate, test.alpha);
  ResultTable table;
  const auto add = [&](const std::string& quantity, double value) { table.add({quantity, value, "1", {}}); };
  add("critical_number", static_cast<double>(critical));
  add("critical_share", static_cast<double>(critical) / static_cast<double>(options.trials));
  add("tail_at_critical_number", upper_tail(critical, options.trials, test.rate));
  add("tail_one_below", upper_tail(critical - 1, options.trials, test.rate));
  for (const double p : true_rates)
    table.add({"power", upper_tail(critical, options.trials, p), "1", {{"true_rate", p}}});
  add_equivalence(table, options);
  if (critical > options.trials)
    add_note(table,
             fmt::format("no count of {} trials can refute a rate of {:g}", options.trials, test.rate));
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_analyse_critical(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<CriticalOptions>();
  app.add_option("--trials", options->trials, "Number of independent trials")
      ->required()
      ->check(whole_number(1, kMostTrials));
  add_test_options(app, options->test);
  add_common_options(app, options->common);
  app.footer("Example: plenolab analyse critical --trials 34 --rate 0.19");
  app.callback([options, &invocation] { run_critical(invocation, *options); });
}

}  // namespace plenolab
