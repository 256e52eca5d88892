#include "experiments/analyse/analyse.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "analysis/psychophysics/binomial.h"
#include "core/base/error.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

template <class Number>
bool parse_whole_text(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc{} && result.ptr == end;
}

}  // namespace

void add_test_options(CLI::App& app, TestOptions& options) {
  app.add_option("--rate", options.rate, "Rate of choosing the test image that a pass refutes")
      ->capture_default_str()
      ->check(number_between(0, 0.999999));
  app.add_option("--alpha", options.alpha, "Chance of passing at that rate, at most")
      ->capture_default_str()
      ->check(number_between(1e-12, 0.5));
  app.add_option("--margin", options.margin, "Margin of equivalence around a rate of 0.5")
      ->capture_default_str()
      ->check(number_between(0.001, 0.5));
  app.add_option("--true-rate", options.true_rates, "True rates at which the power is stated, as P1,P2")
      ->capture_default_str();
}

std::vector<double> parse_numbers(const std::string& text, const std::string& option, double low,
                                  double high) {
  std::vector<double> numbers;
  for (const std::string& part : split_list(text)) {
    double value = 0;
    if (!parse_whole_text(part, value) || !(value >= low && value <= high))
      throw UsageError(fmt::format("{}: give numbers from {:g} to {:g}, separated by commas, not '{}'",
                                   option, low, high, part));
    numbers.push_back(value);
  }
  if (numbers.empty()) throw UsageError(fmt::format("{}: give at least one number", option));
  return numbers;
}

Proportion parse_count(const std::string& text, const std::string& option) {
  const std::vector<std::string> parts = split_list(text);
  Proportion count;
  if (parts.size() != 2 || !parse_whole_text(parts[0], count.hits) ||
      !parse_whole_text(parts[1], count.trials) || count.hits < 0 || count.trials < 1 ||
      count.hits > count.trials || count.trials > kMostTrials)
    throw UsageError(fmt::format("{}: give K,N, K of N trials, e.g. 21,34, not '{}'", option, text));
  return count;
}

void add_plot_option(CLI::App& app, std::string& stem) {
  app.add_option("--plot", stem, "Also draw it: files NAME.svg, NAME-dark.svg, NAME.pdf, NAME.gp, NAME.csv")
      ->check(not_empty());
}

void write_plot_as(const std::string& stem, const Plot& plot, const CommonOptions& common) {
  if (stem.empty()) return;
  const PlotFiles files = write_plot(plot, stem);
  tell(common, fmt::format("wrote {} and its .pdf, .gp and .csv", files.svg.string()));
}

}  // namespace plenolab
