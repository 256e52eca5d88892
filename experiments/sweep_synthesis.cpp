#include "experiments/sweep_synthesis.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "analysis/memory.h"
#include "analysis/pareto.h"
#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/score.h"
#include "metrics/psnr.h"

namespace plenolab {

namespace {

struct Outcome {
  SynthesisSetting setting;
  double psnr_db = 0, samples_per_search = 0, held_mib = 0;
  std::optional<double> peak_mib;
  TimingSummary timing;
  double rms_error() const { return std::pow(10.0, -psnr_db / 20); }
};

const char* name_of(SearchKind search) {
  return search == SearchKind::kLinear ? "linear" : "fast";
}

/// Memory that one synthesis holds when it is done: four key views with disparity, their prepared form, and
/// the result.
double held_memory_mib(const Synthesizer& synthesizer, const NovelView<SceneReferred>& view) {
  const double pixels = static_cast<double>(view.image.size());
  const double key_view_bytes =
      pixels * (sizeof(Rgb) + sizeof(float)) * static_cast<double>(view.views.size());
  const double result_bytes = pixels * (sizeof(Rgb) + 1 + 2 * sizeof(unsigned char));
  return (key_view_bytes + static_cast<double>(synthesizer.prepared_bytes()) + result_bytes) / 0x1p20;
}

/// The cheapest synthesis that prepares the same key views, so that the calls after it find them ready.
void prepare_key_views(const Synthesizer& synthesizer, CameraPosition position, SynthesisOptions options) {
  options.search = SearchKind::kFast;
  options.step_px = 4;
  synthesizer.synthesize(position, options);
}

/// Peak of preparing the key views and synthesising one view from them. They were loaded for the errors, so
/// reading and rendering them does not count.
std::optional<double> measured_peak_mib(const SweepStimulus& stimulus, const SynthesisOptions& options) {
  return peak_memory_mib(
      [&] { Synthesizer(stimulus.key_views).synthesize(stimulus.positions.front(), options); });
}

SynthesisOptions synthesis_options(const SynthesisSetting& setting, int threads) {
  SynthesisOptions synthesis;
  synthesis.search = setting.search;
  synthesis.step_px = setting.step_px;
  synthesis.key_views = setting.key_views;
  synthesis.threads = threads;
  return synthesis;
}

/// Error and run time at all positions; the peak is measured apart, when this synthesizer is gone.
Outcome score_and_time(const SweepStimulus& stimulus, const std::vector<SceneImage>& truths,
                       const SynthesisSetting& setting, const SynthesisSweepOptions& options) {
  const SynthesisOptions synthesis = synthesis_options(setting, options.threads);
  Outcome outcome{.setting = setting, .peak_mib = {}};
  const Synthesizer synthesizer(stimulus.key_views);
  std::vector<double> psnrs, seconds;
  for (std::size_t i = 0; i < stimulus.positions.size(); ++i) {
    prepare_key_views(synthesizer, stimulus.positions[i], synthesis);
    NovelView<SceneReferred> view;
    for (int run = 0; run < options.runs; ++run) {
      const Stopwatch watch;
      view = synthesizer.synthesize(stimulus.positions[i], synthesis);
      seconds.push_back(watch.seconds());
    }
    ComparisonConditions conditions;
    conditions.exposure = exposure_from(truths[i]);
    conditions.threads = options.threads;
    psnrs.push_back(value_of(psnr_gamma(view.image, truths[i], conditions), "psnr_gamma_db"));
    outcome.samples_per_search +=
        view.statistics.samples_per_search() / static_cast<double>(stimulus.positions.size());
    outcome.held_mib = std::max(outcome.held_mib, held_memory_mib(synthesizer, view));
  }
  outcome.psnr_db = pooled_psnr_db(psnrs);
  outcome.timing = summarise_times(seconds);
  return outcome;
}

void add_rows(ResultTable& table, const SweepStimulus& stimulus, const std::vector<Outcome>& outcomes) {
  std::vector<double> errors, seconds;
  for (const Outcome& o : outcomes) {
    errors.push_back(o.rms_error());
    seconds.push_back(o.timing.median_s);
  }
  const std::vector<bool> on_front = pareto_front(errors, seconds);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    const Columns columns{{"scene", stimulus.name},
                          {"width", static_cast<long long>(stimulus.key_views.grid().width)},
                          {"search", std::string(name_of(o.setting.search))},
                          {"step_px", o.setting.step_px},
                          {"key_views", static_cast<long long>(o.setting.key_views)}};
    table.add({"psnr_gamma_db", o.psnr_db, "dB", columns});
    table.add({"rms_error", o.rms_error(), "1", columns});
    add_timing_rows(table, o.timing, columns);
    table.add({"memory_held_mib", o.held_mib, "MiB", columns});
    if (o.peak_mib) table.add({"memory_peak_mib", *o.peak_mib, "MiB", columns});
    table.add({"samples_per_search", o.samples_per_search, "samples", columns});
    table.add({"on_pareto_front", on_front[i] ? 1.0 : 0.0, "1", columns});
  }
}

std::map<std::string, Cell> columns_of(const ResultRow& row) {
  return {row.columns.begin(), row.columns.end()};
}

}  // namespace

std::vector<SynthesisSetting> all_synthesis_settings() {
  std::vector<SynthesisSetting> settings;
  for (const SearchKind search : {SearchKind::kLinear, SearchKind::kFast})
    for (const int key_views : {1, 2, 4})
      for (const double step_px : {0.25, 0.5, 1.0, 2.0, 4.0})
        settings.push_back({search, step_px, key_views});
  return settings;
}

void SynthesisSweepOptions::validate() const {
  if (settings.empty()) throw InputError("a sweep needs at least one setting");
  if (runs < 1) throw InputError(fmt::format("a sweep needs at least one timed run, not {}", runs));
}

ResultTable sweep_synthesis(const std::vector<SweepStimulus>& stimuli, const SynthesisSweepOptions& options,
                            const Progress& progress) {
  options.validate();
  const double total = static_cast<double>(stimuli.size() * options.settings.size());
  double done = 0;
  ResultTable table;
  for (const SweepStimulus& stimulus : stimuli) {
    std::vector<SceneImage> truths;
    for (const CameraPosition& position : stimulus.positions) truths.push_back(stimulus.truth(position));
    std::vector<Outcome> outcomes;
    for (const SynthesisSetting& setting : options.settings) {
      outcomes.push_back(score_and_time(stimulus, truths, setting, options));
      outcomes.back().peak_mib = measured_peak_mib(stimulus, synthesis_options(setting, options.threads));
      if (progress) progress(++done / total);
    }
    add_rows(table, stimulus, outcomes);
  }
  return table;
}

Plot plot_synthesis_sweep(const ResultTable& rows, const std::string& scene, int width) {
  std::map<std::string, std::map<double, PlotPoint>> series;
  for (const ResultRow& row : rows.rows()) {
    const auto columns = columns_of(row);
    if (std::get<std::string>(columns.at("scene")) != scene ||
        std::get<long long>(columns.at("width")) != width)
      continue;
    const double step_px = std::get<double>(columns.at("step_px"));
    const long long views = std::get<long long>(columns.at("key_views"));
    const std::string title =
        fmt::format("{} search, {} key view{}", std::get<std::string>(columns.at("search")), views,
                    views == 1 ? "" : "s");
    PlotPoint& point = series[title][step_px];
    if (row.quantity == "psnr_gamma_db") point.y = row.value;
    if (row.quantity == "seconds_median") point.x = row.value * 1000;
    if (row.quantity == "on_pareto_front") point.marked = row.value != 0;
    point.label = format_number(step_px);
  }
  Plot plot;
  plot.x = {.title = "Run time, median", .unit = "ms", .logarithmic = true};
  plot.y = {.title = "PSNR, gamma-encoded", .unit = "dB"};
  plot.marked_title = "Pareto front";
  plot.key = KeyPosition::kOutside;
  for (auto& [title, points] : series) {
    PlotSeries& s = plot.series.emplace_back(PlotSeries{.title = title});
    for (auto& [step, point] : points) s.points.push_back(point);
  }
  return plot;
}

}  // namespace plenolab
