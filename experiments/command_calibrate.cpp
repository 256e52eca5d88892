#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/calibration/measurement_file.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/calibration/calibration_page.h"
#include "experiments/calibration/calibration_results.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/suggest.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct CalibrateOptions {
  CommonOptions common;
  std::string measurements, simulate, coverage, out;
  std::string loss = "huber", free, fix;
  double loss_scale = 0;
  int starts = 6, rigs = 1000;
  bool force = false;
};

CalibrationLoss loss_named(const std::string& name) {
  if (name == "none") return CalibrationLoss::kNone;
  return name == "cauchy" ? CalibrationLoss::kCauchy : CalibrationLoss::kHuber;
}

CalibrationFitOptions fit_options(const CalibrateOptions& options) {
  return {.loss = loss_named(options.loss),
          .loss_scale = options.loss_scale,
          .starts = options.starts,
          .seed = options.common.seed};
}

/// Gives the parameters in a list another role. Throws UsageError with the nearest name for one that there is
/// not.
void set_roles(ParameterSettings& settings, const std::string& list, const std::string& option,
               ParameterSetting::Role role) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < kCalibrationParameters; ++i) known.emplace_back(traits_of(i).name);
  for (const std::string& name : split_list(list)) {
    const auto parameter = parameter_named(name);
    if (!parameter)
      throw UsageError(
          fmt::format("{}: there is no parameter '{}'{}", option, name, did_you_mean(name, known)));
    settings[index_of(*parameter)].role = role;
  }
}

void add_notes(ResultTable& table, const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) table.add({kNoteQuantity, 0, "1", {{"note", sentence}}});
}

void print_table(const ResultTable& rows, const WideDesign& design) {
  fmt::print("{}\n", to_wide_text(rows, design.keys, design.columns));
}

void run_simulate(const Invocation& invocation, const CalibrateOptions& options) {
  if (options.out.empty()) throw UsageError("--simulate needs -o FILE.json for the measurements");
  Provenance provenance = begin_run(invocation, options.common);
  const CalibrationRig rig = read_rig(options.simulate);
  add_input(provenance, options.simulate);
  require_keeps_inputs(provenance, options.out);
  const CalibrationMeasurements measurements = simulate_measurements(rig, options.common.seed);
  write_text_file(options.out, format_measurements(measurements));
  write_run_json_beside(options.out, provenance);
  ResultTable table;
  table.add({"records", static_cast<double>(measurements.records.size()), "1", {{"file", options.out}}});
  write_results(table, provenance, options.common);
  tell(options.common, fmt::format("wrote {} records to {}", measurements.records.size(), options.out));
}

void run_coverage(const Invocation& invocation, const CalibrateOptions& options) {
  if (!options.out.empty()) throw UsageError("--coverage writes no file of its own: use --json or --csv");
  Provenance provenance = begin_run(invocation, options.common);
  const CalibrationRig rig = read_rig(options.coverage);
  add_input(provenance, options.coverage);
  CoverageOptions coverage{
      .rigs = options.rigs, .seed = options.common.seed, .threads = options.common.threads};
  coverage.fit = fit_options(options);
  const CoverageResult result = measure_coverage(rig, coverage);
  const ResultTable table = coverage_rows(result);
  if (!output_is_for_programs(options.common)) print_table(table, coverage_design());
  write_results(table, provenance, options.common);
  tell(options.common,
       fmt::format("{} of {} fits converged, in {:.2f} s", result.converged, result.rigs, result.seconds));
}

CalibrationMeasurements measurements_of(const CalibrateOptions& options) {
  CalibrationMeasurements measurements = read_measurements(options.measurements);
  set_roles(measurements.parameters, options.free, "--free", ParameterSetting::Role::kFree);
  set_roles(measurements.parameters, options.fix, "--fix", ParameterSetting::Role::kFixed);
  measurements.validate(options.measurements);
  return measurements;
}

void write_page(const CalibrateOptions& options, const CalibrationPage& page, const ResultTable& rows,
                const fs::path& folder) {
  for (const NamedPlot& plot : page.plots) write_plot(plot.plot.plot, folder / plot.name);
  write_text_file(folder / "rows.csv", to_csv(rows));
  write_text_file(folder / "measurements.json", read_text_file(options.measurements));
  write_report(page.report, folder / "report.html");
}

/// Each table with its sentences.
void tell_fit(const CalibrateOptions& options, const ResultTable& rows, const CalibrationFit& fit,
              const std::vector<DoubtedSource>& doubts) {
  const bool for_people = !output_is_for_programs(options.common);
  if (for_people) print_table(rows, estimate_design());
  for (const std::string& sentence : calibration_sentences(fit)) tell(options.common, sentence);
  if (doubts.empty()) return;
  tell(options.common, "\nPlain least squares, without one source after the other:");
  if (for_people) print_table(doubt_rows(doubts), doubt_design(doubts));
  for (const std::string& sentence : doubt_sentences(doubts)) tell(options.common, sentence);
}

void run_fit(const Invocation& invocation, const CalibrateOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  const CalibrationMeasurements measurements = measurements_of(options);
  add_input(provenance, options.measurements);
  provenance.parameters["loss"] = options.loss;
  provenance.parameters["starts"] = options.starts;
  const CalibrationFitOptions fitting = fit_options(options);
  const CalibrationFit fit = fit_calibration(measurements, fitting);
  if (!fit.converged)
    throw InputError(fmt::format("the fit to {} did not converge: {}", options.measurements, fit.message));
  std::vector<DoubtedSource> doubts;
  if (contradicts(fit) && !isolated_outliers(fit)) doubts = doubt_each_source(measurements, fitting);
  ResultTable rows = calibration_rows(measurements, fit);
  rows.append(doubt_rows(doubts));
  tell_fit(options, rows, fit, doubts);
  for (const auto& sentences : {calibration_sentences(fit), doubt_sentences(doubts)})
    add_notes(rows, sentences);
  if (!options.out.empty()) {
    const ResultFolder folder{options.out, "calibrate", item_path(options.measurements), options.force};
    write_result_folder(folder, provenance, [&](const fs::path& temporary) {
      const std::string title = "Calibration: " + fs::path(options.measurements).stem().string();
      finish_provenance(provenance);
      write_page(options, calibration_page(title, measurements, fit, doubts, provenance), rows, temporary);
    });
    tell(options.common, fmt::format("wrote {}", (fs::path(options.out) / "report.html").string()));
  }
  write_results(rows, provenance, options.common);
}

void run_calibrate(const Invocation& invocation, const CalibrateOptions& options) {
  const int asked = !options.measurements.empty() + !options.simulate.empty() + !options.coverage.empty();
  if (asked != 1)
    throw UsageError(
        "give a file of measurements, or --simulate RIG.json, or --coverage RIG.json, and only one "
        "of them");
  if (!options.simulate.empty()) return run_simulate(invocation, options);
  if (!options.coverage.empty()) return run_coverage(invocation, options);
  run_fit(invocation, options);
}

}  // namespace

void add_calibrate_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<CalibrateOptions>();
  app.add_option("measurements", options->measurements,
                 "Measurement records (.json, see analysis/calibration/README.md)")
      ->check(not_empty());
  app.add_option("--simulate", options->simulate,
                 "Simulate the measurements of a rig (.json) and write them to -o")
      ->check(not_empty());
  app.add_option("--coverage", options->coverage,
                 "How often the 95 % intervals hold the truth, over many simulations of a rig (.json)")
      ->check(not_empty());
  app.add_option("--rigs", options->rigs, "Simulated rigs of --coverage")
      ->check(whole_number(1, 1000000))
      ->capture_default_str();
  app.add_option("-o,--out", options->out, "Folder for the report; with --simulate the file of measurements")
      ->check(not_empty());
  app.add_option("--loss", options->loss, "What outliers cost")
      ->check(one_of({"huber", "cauchy", "none"}))
      ->capture_default_str();
  app.add_option(
         "--loss-scale", options->loss_scale,
         "Standard deviations beyond which the loss doubts a reading (default: 1.345 Huber, 2.385 Cauchy)")
      ->check(positive_number());
  app.add_option("--starts", options->starts, "Places from which the search begins")
      ->check(whole_number(1, 10000))
      ->capture_default_str();
  app.add_option("--free", options->free, "Parameters to free, comma-separated, whatever the file says");
  app.add_option("--fix", options->fix, "Parameters to hold at their nominal values");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab calibrate measurements.json -o results/calibration\n"
      "          plenolab calibrate --simulate display.rig.json -o measurements.json\n"
      "          plenolab calibrate --coverage display.rig.json --rigs 1000");
  app.callback([options, &invocation] { run_calibrate(invocation, *options); });
}

}  // namespace plenolab
