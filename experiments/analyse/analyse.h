#pragma once

#include <string>
#include <vector>

#include "analysis/plot.h"
#include "analysis/psychophysics/proportion.h"
#include "experiments/cli/output.h"
#include "experiments/commands.h"

namespace CLI {
class App;
}

namespace plenolab {

/// The subcommands of `plenolab analyse`, one file each, and what they share.

void add_analyse_critical(CLI::App& app, const Invocation& invocation);
void add_analyse_table(CLI::App& app, const Invocation& invocation);
void add_analyse_psychometric(CLI::App& app, const Invocation& invocation);
void add_analyse_welch(CLI::App& app, const Invocation& invocation);
void add_analyse_dprime(CLI::App& app, const Invocation& invocation);
void add_analyse_plan(CLI::App& app, const Invocation& invocation);

/// What a binomial test is about.
struct TestOptions {
  double rate = 0.19;  ///< that a pass refutes
  double alpha = 0.05;
  double margin = 0.15;  ///< of equivalence around 0.5
  std::string true_rates = "0.25,0.5";
};

/// Declares --rate, --alpha, --margin and --true-rate.
void add_test_options(CLI::App& app, TestOptions& options);

/// "0.25,0.5" as numbers. Throws UsageError that names the option unless each lies in [low, high].
std::vector<double> parse_numbers(const std::string& text, const std::string& option, double low,
                                  double high);

/// "K,N" as a count, K of N. Throws UsageError that names the option.
Proportion parse_count(const std::string& text, const std::string& option);

/// Declares --plot, a file name without extension.
void add_plot_option(CLI::App& app, std::string& stem);
/// Writes the plot's files if a name was given, and says so.
void write_plot_as(const std::string& stem, const Plot& plot, const CommonOptions& common);

}  // namespace plenolab
