#include "experiments/sweep_luminance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "analysis/pareto.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr int kReferenceSamples = 10'000, kTruePictures = 25;
constexpr const char *kError = "rms_error", *kFront = "on_pareto_front",
                     *kErrorToScene = "rms_error_to_scene", *kFrontToScene = "on_pareto_front_to_scene";

std::vector<LuminanceOptions> all_methods(const ShownField& field) {
  std::vector<LuminanceOptions> methods;
  for (const PinholeSize size : {PinholeSize{64, 36}, {256, 144}, field.display->resolution()})
    methods.push_back({.method = LuminanceMethod::kBruteForce, .pinhole = size});
  methods.push_back({.method = LuminanceMethod::kAccumulative});
  methods.push_back({.method = LuminanceMethod::kAccumulative, .smoothed = true});
  methods.push_back({.method = LuminanceMethod::kSpread});
  methods.push_back({.method = LuminanceMethod::kSpread, .normalised_spread = false});
  return methods;
}

/// ln L̄ of the scene itself along the line.
struct Truth {
  std::vector<double> x_m, ln_luminance;
};

Truth truth_of(const ShownField& field, int threads) {
  Truth truth;
  if (!field.scene) return truth;
  const ObserverSamples positions = samples_of(*field.display, kTruePictures, 1);
  for (int i = 0; i < positions.size(); ++i) {
    const SceneImage picture = render_pinhole(*field.scene, field.display->space(), positions.position(i),
                                              field.display->resolution(), {.threads = threads});
    if (const auto ln = log_average(picture)) {
      truth.x_m.push_back(positions.position(i).x_m);
      truth.ln_luminance.push_back(*ln);
    }
  }
  return truth;
}

double rms_error_to(const Truth& truth, const GlobalLuminance& estimate) {
  double squares = 0;
  for (std::size_t i = 0; i < truth.x_m.size(); ++i) {
    const double d = *estimate.ln_at({truth.x_m[i], 0}) - truth.ln_luminance[i];
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(truth.x_m.size()));
}

struct Errors {
  double rms = 0, largest = 0;
};

Errors errors_of(const GlobalLuminance& estimate, const GlobalLuminance& reference) {
  Errors errors;
  const int count = reference.samples.size();
  for (int i = 0; i < count; ++i) {
    const double d =
        *estimate.ln_at(reference.samples.position(i)) - reference.ln_luminance[static_cast<std::size_t>(i)];
    errors.rms += d * d / count;
    errors.largest = std::max(errors.largest, std::abs(d));
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

/// The reference has no error against itself.
bool is_reference(const ShownField& field, const LuminanceOptions& options, int samples) {
  return options.method == LuminanceMethod::kBruteForce && options.pinhole == field.display->resolution() &&
         samples == kReferenceSamples;
}

Columns columns_of(const std::string& scene, const SweepOutcome& outcome) {
  Columns columns{{"scene", scene}};
  columns.insert(columns.end(), outcome.setting.begin(), outcome.setting.end());
  return columns;
}

void add_outcome(ResultTable& table, const std::string& scene, const SweepOutcome& outcome) {
  const Columns columns = columns_of(scene, outcome);
  add_measurement_rows(table, outcome.values, columns);
  add_timing_rows(table, outcome.timing, columns);
  if (outcome.peak_mib) table.add({"memory_peak_mib", *outcome.peak_mib, "MiB", columns});
}

SweepOutcome outcome_of(const ShownField& field, const LuminanceOptions& options, int samples,
                        const GlobalLuminance& reference, const Truth& truth, int runs) {
  const bool pictures = options.method == LuminanceMethod::kBruteForce;
  SweepOutcome outcome{
      .setting = {
          {"method", setting_name(options)},
          {"pinhole", pictures ? fmt::format("{}x{}", options.pinhole.width, options.pinhole.height) : ""},
          {"samples", static_cast<long long>(samples)}}};
  GlobalLuminance estimate;
  const ObserverSamples positions = samples_of(*field.display, samples);
  time_setting(
      outcome, [&] { estimate = estimate_luminance(*field.display, field.luminance, positions, options); },
      runs);
  if (!estimate.known())
    throw InputError(fmt::format("{}: no ray is above ε, there is nothing to sweep", field.name));
  outcome.values = {{"undefined_samples", static_cast<double>(estimate.undefined()), "samples"}};
  if (!is_reference(field, options, samples)) {
    const Errors errors = errors_of(estimate, reference);
    outcome.values.push_back({kError, errors.rms, "1"});
    outcome.values.push_back({"max_error", errors.largest, "1"});
  }
  if (!truth.x_m.empty()) outcome.values.push_back({kErrorToScene, rms_error_to(truth, estimate), "1"});
  return outcome;
}

std::optional<double> value_of(const SweepOutcome& outcome, const char* quantity) {
  for (const Measurement& value : outcome.values)
    if (value.quantity == quantity) return value.value;
  return std::nullopt;
}

/// Whether no other setting is both faster and better, of those that have the error.
void add_front(ResultTable& table, const std::string& scene, const std::vector<SweepOutcome>& outcomes,
               const char* error, const char* front) {
  std::vector<const SweepOutcome*> compared;
  std::vector<double> errors, seconds;
  for (const SweepOutcome& outcome : outcomes) {
    const std::optional<double> value = value_of(outcome, error);
    if (!value) continue;
    compared.push_back(&outcome);
    errors.push_back(*value);
    seconds.push_back(outcome.timing.median_s);
  }
  const std::vector<bool> on_front = pareto_front(errors, seconds);
  for (std::size_t i = 0; i < compared.size(); ++i)
    table.add({front, on_front[i] ? 1.0 : 0.0, "1", columns_of(scene, *compared[i])});
}

/// What the plot shows of a row's setting.
struct PlottedRow {
  std::string series;
  long long samples = 0;
};

PlottedRow plotted(const ResultRow& row) {
  PlottedRow shown;
  for (const auto& [name, cell] : row.columns) {
    if (name == "method") shown.series = std::get<std::string>(cell);
    if (name == "samples") shown.samples = std::get<long long>(cell);
    if (name == "pinhole" && !std::get<std::string>(cell).empty())
      shown.series += fmt::format(", {} px", std::get<std::string>(cell));
  }
  return shown;
}

/// Leaves only labels that do not lie upon each other: methods with like errors are like in time, too.
void thin_out_labels(Plot& plot) {
  constexpr double kApartAcross = 0.1, kApartDown = 0.05;  // shares of the axes
  double x_low = HUGE_VAL, x_high = -HUGE_VAL, y_low = HUGE_VAL, y_high = -HUGE_VAL;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& p : series.points) {
      std::tie(x_low, x_high) = std::pair{std::min(x_low, std::log(p.x)), std::max(x_high, std::log(p.x))};
      std::tie(y_low, y_high) = std::pair{std::min(y_low, std::log(p.y)), std::max(y_high, std::log(p.y))};
    }
  }
  std::vector<const PlotPoint*> labelled;
  for (PlotSeries& series : plot.series) {
    for (PlotPoint& p : series.points) {
      const bool taken = std::any_of(labelled.begin(), labelled.end(), [&](const PlotPoint* other) {
        return std::abs(std::log(p.x / other->x)) < kApartAcross * (x_high - x_low) &&
               std::abs(std::log(p.y / other->y)) < kApartDown * (y_high - y_low);
      });
      if (taken)
        p.label.clear();
      else
        labelled.push_back(&p);
    }
  }
}

}  // namespace

ResultTable sweep_luminance(const ShownField& field, const SweepRun& run) {
  const GlobalLuminance reference =
      estimate_luminance(*field.display, field.luminance, samples_of(*field.display, kReferenceSamples, 1),
                         {.method = LuminanceMethod::kBruteForce,
                          .pinhole = field.display->resolution(),
                          .threads = run.threads});
  if (!reference.known())
    throw InputError(
        fmt::format("{}: no ray is above ε, so that there is no luminance to estimate", field.name));
  const Truth truth = truth_of(field, run.threads);
  std::vector<SweepOutcome> outcomes;
  const std::vector<LuminanceOptions> methods = all_methods(field);
  for (LuminanceOptions method : methods) {
    method.threads = run.threads;
    for (const int samples : {10, 100, 1000, 10'000}) {
      outcomes.push_back(outcome_of(field, method, samples, reference, truth, run.runs));
      if (run.progress)
        run.progress(static_cast<double>(outcomes.size()) / (4.0 * static_cast<double>(methods.size())));
    }
  }
  ResultTable table;
  for (const SweepOutcome& outcome : outcomes) add_outcome(table, field.name, outcome);
  add_front(table, field.name, outcomes, kError, kFront);
  add_front(table, field.name, outcomes, kErrorToScene, kFrontToScene);
  return table;
}

Plot plot_luminance_sweep(const ResultTable& rows, LuminanceTruth truth) {
  const bool to_scene = truth == LuminanceTruth::kScene;
  std::vector<std::string> order;
  std::map<std::string, std::map<long long, PlotPoint>> series;
  for (const ResultRow& row : rows.rows()) {
    const PlottedRow shown = plotted(row);
    if (!series.count(shown.series)) order.push_back(shown.series);
    PlotPoint& point = series[shown.series][shown.samples];
    point.label = fmt::format("{}", shown.samples);
    if (row.quantity == (to_scene ? kErrorToScene : kError)) point.y = row.value;
    if (row.quantity == (to_scene ? kFrontToScene : kFront)) point.marked = row.value != 0;
    if (row.quantity == "seconds_median") point.x = row.value * 1000;
  }
  Plot plot;
  plot.title = "Labels: samples along the line; lines join 10, 100, 1000 and 10000";
  plot.x = {.title = "Run time, median", .unit = "ms", .logarithmic = true};
  plot.y = {.title = to_scene ? "RMS error of ln L̄, to the scene" : "RMS error of ln L̄, to brute force",
            .unit = "1",
            .logarithmic = true};
  plot.marked_title = "Pareto front";
  plot.key = KeyPosition::kOutside;
  plot.width_px = 1000, plot.height_px = 520;
  for (const std::string& title : order) {
    PlotSeries shown{.title = title};
    for (const auto& [samples, point] : series[title])
      if (point.y > 0) shown.points.push_back(point);
    if (!shown.points.empty()) plot.series.push_back(std::move(shown));
  }
  thin_out_labels(plot);
  return plot;
}

}  // namespace plenolab
