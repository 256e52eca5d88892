#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/psychophysics/planning.h"
#include "core/base/error.h"
#include "experiments/analyse/analyse.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

struct PlanOptions {
  CommonOptions common;
  TestOptions test;
  std::string powers = "0.8,0.9,0.95", plot;
};

void add_size(ResultTable& table, const SampleSize& size, const std::string& test, double true_rate,
              double power) {
  const std::vector<std::pair<std::string, Cell>> columns{
      {"test", test}, {"true_rate", true_rate}, {"power", power}};
  table.add({"trials_first", static_cast<double>(size.first), "1", columns});
  table.add({"trials_stable", static_cast<double>(size.stable), "1", columns});
}

ResultTable plan_rows(const PlanOptions& options, const std::vector<double>& true_rates,
                      const std::vector<double>& powers) {
  const TestOptions& test = options.test;
  const EquivalenceOptions equivalence{.margin = test.margin, .alpha = test.alpha};
  ResultTable table;
  for (const double power : powers) {
    for (const double p : true_rates) {
      const SampleSize size =
          plan_test({.p_null = test.rate, .p_true = p, .alpha = test.alpha, .power = power});
      add_size(table, size, fmt::format("rate above {:g}", test.rate), p, power);
    }
    add_size(table, plan_equivalence(equivalence, 0.5, power),
             fmt::format("rate within 0.5 ± {:g}", test.margin), 0.5, power);
  }
  return table;
}

Plot power_plot(const PlanOptions& options, const std::vector<double>& true_rates) {
  constexpr std::int64_t kMost = 150;
  Plot plot;
  plot.x = {.title = "Trials"};
  plot.y = {.title = "Power", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  for (const double p : true_rates) {
    PlotSeries series{fmt::format("true rate {:g}", p), PlotSeries::Style::kLines, {}};
    const std::vector<double> powers = power_curve(options.test.rate, p, options.test.alpha, kMost);
    for (std::size_t i = 0; i < powers.size(); ++i)
      series.points.push_back({.x = static_cast<double>(i + 1), .y = powers[i]});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

void run_plan(const Invocation& invocation, const PlanOptions& options) {
  const std::vector<double> true_rates = parse_numbers(options.test.true_rates, "--true-rate", 0, 1);
  const std::vector<double> powers = parse_numbers(options.powers, "--power", 0.01, 0.999999);
  for (const double p : true_rates)
    if (p <= options.test.rate)
      throw UsageError(
          fmt::format("--true-rate: {:g} must be above the tested --rate {:g}", p, options.test.rate));
  Provenance provenance = begin_run(invocation, options.common);
  emit_results(plan_rows(options, true_rates, powers), provenance, options.common);
  if (!options.plot.empty()) write_plot_as(options.plot, power_plot(options, true_rates), options.common);
}

}  // namespace

void add_analyse_plan(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<PlanOptions>();
  options->test.true_rates = "0.35,0.5";
  add_test_options(app, options->test);
  app.add_option("--power", options->powers, "Powers wanted, as P1,P2")->capture_default_str();
  add_plot_option(app, options->plot);
  add_common_options(app, options->common);
  app.footer("Example: plenolab analyse plan --true-rate 0.35,0.5 --power 0.8,0.95 --margin 0.15");
  app.callback([options, &invocation] { run_plan(invocation, *options); });
}

}  // namespace plenolab
