#include "experiments/sweep_luminance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr int kReferenceSamples = 10'000, kTruePictures = 25;

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
  const Errors errors = errors_of(estimate, reference);
  outcome.error = errors.rms;
  outcome.values = {{"rms_error", errors.rms, "1"},
                    {"max_error", errors.largest, "1"},
                    {"undefined_samples", static_cast<double>(estimate.undefined()), "samples"}};
  if (!truth.x_m.empty())
    outcome.values.push_back({"rms_error_to_scene", rms_error_to(truth, estimate), "1"});
  return outcome;
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
  add_outcome_rows(table, {{"scene", field.name}}, outcomes);
  return table;
}

SweepPlotDesign luminance_sweep_plot() {
  return {"rms_error", "RMS error of ln L̄", "1", {"method", "pinhole"}, "samples"};
}

}  // namespace plenolab
