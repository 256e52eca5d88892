#include "analysis/psychophysics/psychometric.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/csv.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/analyse/analyse.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

struct FitOptions {
  CommonOptions common;
  std::string file, shape = "normal", guess = "0.5", lapse = "0", plot;
  int resamples = 1000;
  double confidence = 0.95;
};

std::vector<PsychometricLevel> levels_of(const CsvTable& table) {
  constexpr double kAny = std::numeric_limits<double>::max();
  std::vector<PsychometricLevel> levels;
  for (const CsvRow& row : table.rows) {
    PsychometricLevel level{table.number(row, "x", -kAny, kAny), {}};
    level.noticed.trials = table.whole(row, "n", 1, 1'000'000);
    level.noticed.hits = table.whole(row, "k", 0, level.noticed.trials);
    levels.push_back(level);
  }
  return levels;
}

/// A rate to hold, or "free".
void set_rate(const std::string& text, const std::string& option, double& rate, bool& is_free) {
  is_free = text == "free";
  if (!is_free) rate = parse_numbers(text, option, 0, 0.999).front();
}

PsychometricOptions psychometric_options(const FitOptions& options) {
  PsychometricOptions fit;
  fit.shape = options.shape == "logistic"  ? PsychometricShape::kLogistic
              : options.shape == "weibull" ? PsychometricShape::kWeibull
                                           : PsychometricShape::kNormal;
  set_rate(options.guess, "--guess", fit.guess_rate, fit.free_guess);
  set_rate(options.lapse, "--lapse", fit.lapse_rate, fit.free_lapse);
  fit.resamples = options.resamples;
  fit.confidence = options.confidence;
  fit.seed = options.common.seed;
  return fit;
}

ResultTable rows_of(const PsychometricFit& fit) {
  ResultTable table;
  const auto add = [&](const std::string& quantity, double value) { table.add({quantity, value, "1", {}}); };
  const auto add_interval = [&](const std::string& quantity, double value, const std::optional<Interval>& i) {
    add(quantity, value);
    if (i) add(quantity + "_low", i->low), add(quantity + "_high", i->high);
  };
  if (fit.status == PsychometricStatus::kFitted) {
    add_interval("threshold", fit.threshold, fit.threshold_interval);
    add_interval("scale", fit.scale, fit.scale_interval);
    add("location", fit.location);
    add_interval("lapse_rate", fit.lapse_rate, fit.lapse_interval);
    add("guess_rate", fit.guess_rate);
  }
  add("determined", fit.status == PsychometricStatus::kFitted ? 1 : 0);
  add("negative_log_likelihood", fit.negative_log_likelihood);
  add("deviance", fit.deviance);
  if (fit.deviance_p) add("deviance_p", *fit.deviance_p);
  if (fit.degenerate_resamples > 0) add("degenerate_resamples", fit.degenerate_resamples);
  if (const std::string text = status_text(fit.status); !text.empty())
    table.add({kNoteQuantity, 0, "1", {{"note", text}}});
  return table;
}

PlotSeries observed(const std::vector<PsychometricLevel>& levels) {
  PlotSeries series{"answers", PlotSeries::Style::kPoints, {}};
  for (const PsychometricLevel& level : levels) {
    const Interval share = clopper_pearson(level.noticed);
    series.points.push_back({.x = level.x, .y = share.estimate, .y_low = share.low, .y_high = share.high});
  }
  return series;
}

Plot plot_of(const PsychometricFit& fit, const std::vector<PsychometricLevel>& levels) {
  Plot plot;
  plot.x = {.title = "Level"};
  plot.y = {.title = "Share of answers", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  plot.series.push_back(observed(levels));
  if (fit.status != PsychometricStatus::kFitted) return plot;
  const auto [low, high] =
      std::minmax_element(levels.begin(), levels.end(),
                          [](const PsychometricLevel& a, const PsychometricLevel& b) { return a.x < b.x; });
  PlotSeries curve{"fit", PlotSeries::Style::kLines, {}};
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = low->x + (high->x - low->x) * i / kSteps;
    curve.points.push_back({.x = x, .y = psychometric_value(fit, x)});
  }
  plot.series.push_back(std::move(curve));
  return plot;
}

void run_psychometric(const Invocation& invocation, const FitOptions& options) {
  const PsychometricOptions with = psychometric_options(options);
  Provenance provenance = begin_run(invocation, options.common);
  const std::vector<PsychometricLevel> levels =
      levels_of(parse_csv(read_text_file(options.file), options.file));
  add_input(provenance, options.file);
  const PsychometricFit fit = fit_psychometric(levels, with);
  emit_results(rows_of(fit), provenance, options.common);
  if (!options.plot.empty()) write_plot_as(options.plot, plot_of(fit, levels), options.common);
}

}  // namespace

void add_analyse_psychometric(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<FitOptions>();
  app.add_option("file", options->file, "CSV with the columns x (level), n (trials) and k (noticed)")
      ->required();
  app.add_option("--shape", options->shape, "normal, logistic or weibull")
      ->capture_default_str()
      ->check(one_of({"normal", "logistic", "weibull"}));
  app.add_option("--guess", options->guess, "Share of answers when guessing, or free")->capture_default_str();
  app.add_option("--lapse", options->lapse, "Share of lapses, or free (up to 0.1)")->capture_default_str();
  app.add_option("--resamples", options->resamples, "Of the parametric bootstrap, 0 = no intervals")
      ->capture_default_str()
      ->check(whole_number(0, 1'000'000));
  app.add_option("--confidence", options->confidence, "Of the intervals")
      ->capture_default_str()
      ->check(number_between(0.5, 0.999));
  add_plot_option(app, options->plot);
  add_common_options(app, options->common);
  app.footer(
      "Example: plenolab analyse psychometric levels.csv --guess 0.5 --lapse free --plot results/curve");
  app.callback([options, &invocation] { run_psychometric(invocation, *options); });
}

}  // namespace plenolab
