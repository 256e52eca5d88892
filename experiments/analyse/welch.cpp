#include "analysis/psychophysics/welch.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "analysis/psychophysics/csv.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/analyse/analyse.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

struct WelchOptions {
  CommonOptions common;
  std::string first, second, column;
  int block_length = 0, resamples = 2000;
  double confidence = 0.95;
};

/// A sample as given: its values, or only what a paper printed of them.
struct Sample {
  SampleSummary summary;
  std::vector<double> values;  ///< empty if not known
};

std::vector<double> read_values(const std::string& file, const std::string& column) {
  constexpr double kAny = std::numeric_limits<double>::max();
  const CsvTable table = parse_csv(read_text_file(file), file);
  if (column.empty() && table.columns.size() != 1)
    throw UsageError(
        fmt::format("--column: {} has {} columns, say which holds the values", file, table.columns.size()));
  const std::string name = column.empty() ? table.columns.front() : column;
  std::vector<double> values;
  for (const CsvRow& row : table.rows) values.push_back(table.number(row, name, -kAny, kAny));
  return values;
}

/// "MEAN,SD,N", or the name of a file.
Sample read_sample(const std::string& text, const std::string& option, const std::string& column,
                   Provenance& provenance) {
  if (split_list(text).size() == 3) {
    const std::vector<double> numbers = parse_numbers(text, option, -1e300, 1e300);
    if (numbers[2] != std::floor(numbers[2]) || !(numbers[2] >= 2 && numbers[2] <= 1e15))
      throw UsageError(fmt::format("{}: N must be a whole number from 2, not {:g}", option, numbers[2]));
    return {{numbers[0], numbers[1], static_cast<std::int64_t>(numbers[2])}, {}};
  }
  std::vector<double> values = read_values(text, column);
  add_input(provenance, text);
  const SampleSummary summary = summarise(values);
  return {summary, std::move(values)};
}

void add_bootstrap(ResultTable& table, const Sample& first, const Sample& second,
                   const WelchOptions& options) {
  BootstrapOptions bootstrap{.confidence = options.confidence,
                             .resamples = options.resamples,
                             .seed = options.common.seed,
                             .block_length = options.block_length};
  if (bootstrap.block_length == 0)
    bootstrap.block_length = std::max(block_length_for(first.values), block_length_for(second.values));
  const Interval i = block_bootstrap_difference(first.values, second.values, bootstrap);
  table.add({"block_length", static_cast<double>(bootstrap.block_length), "1", {}});
  table.add({"block_bootstrap_low", i.low, "1", {}});
  table.add({"block_bootstrap_high", i.high, "1", {}});
}

void run_welch(const Invocation& invocation, const WelchOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  const Sample first = read_sample(options.first, "--first", options.column, provenance);
  const Sample second = read_sample(options.second, "--second", options.column, provenance);
  const WelchTest test = welch_test(first.summary, second.summary, options.confidence);
  ResultTable table;
  const auto add = [&](const std::string& quantity, double value) { table.add({quantity, value, "1", {}}); };
  add("difference", test.difference.estimate);
  add("difference_low", test.difference.low);
  add("difference_high", test.difference.high);
  add("t", test.t);
  add("degrees_of_freedom", test.degrees_of_freedom);
  add("p_value", test.p_two_sided);
  add("log10_p", test.log10_p);
  if (!first.values.empty() && !second.values.empty()) add_bootstrap(table, first, second, options);
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_analyse_welch(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<WelchOptions>();
  app.add_option("--first", options->first, "MEAN,SD,N of the first sample, or a CSV file of its values")
      ->required();
  app.add_option("--second", options->second, "The same of the second sample")->required();
  app.add_option("--column", options->column, "Column of the files (not needed where there is one)");
  app.add_option(
         "--block-length", options->block_length,
         "Values in sequence that are drawn together in the bootstrap, 0 = from their autocorrelation")
      ->capture_default_str()
      ->check(whole_number(0, 1'000'000));
  app.add_option("--resamples", options->resamples, "Of the bootstrap")
      ->capture_default_str()
      ->check(whole_number(100, 1'000'000));
  app.add_option("--confidence", options->confidence, "Of the intervals")
      ->capture_default_str()
      ->check(number_between(0.5, 0.999999));
  add_common_options(app, options->common);
  app.footer("Example: plenolab analyse welch --first 0.1870,0.1577,1000 --second 0.0184,0.0027,1000");
  app.callback([options, &invocation] { run_welch(invocation, *options); });
}

}  // namespace plenolab
