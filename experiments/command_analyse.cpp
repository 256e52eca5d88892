#include <CLI/CLI.hpp>

#include "experiments/analyse/analyse.h"

namespace plenolab {

void add_analyse_command(CLI::App& app, const Invocation& invocation);

void add_analyse_command(CLI::App& app, const Invocation& invocation) {
  app.require_subcommand(1);
  const auto add = [&](const char* name, const char* summary, void (*declare)(CLI::App&, const Invocation&)) {
    declare(*app.add_subcommand(name, summary), invocation);
  };
  add("critical", "Smallest count that passes a test, its chance, its power", add_analyse_critical);
  add("table", "Counts or trials of a study: verdicts and what stands behind them", add_analyse_table);
  add("psychometric", "Fit a psychometric function", add_analyse_psychometric);
  add("welch", "Compare two means, from values or from what a paper prints", add_analyse_welch);
  add("dprime", "Sensitivity from correct answers, or hits and false alarms", add_analyse_dprime);
  add("plan", "How many trials a study needs", add_analyse_plan);
  app.footer(
      "Example: plenolab analyse table trials.csv\n"
      "'plenolab analyse WHAT --help' explains each of them and gives an example.");
}

}  // namespace plenolab
