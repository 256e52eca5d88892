#include "core/base/error.h"
#include "core/tonemap/bilateral.h"
#include "core/tonemap/filters/bilateral_input.h"
#include "experiments/sweep_errors.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

namespace {

/// A filter on one image, as the operator calls it.
struct FilterCase {
  std::string name;
  const Plane<float>& log_luminance;
  BilateralOptions widths;
  std::optional<DepthGuide> depth;
  int threads;

  BilateralInput input() const { return {log_luminance, log_luminance, widths, depth, threads}; }
};

Columns columns_of(const FilterCase& filter, const std::string& method, const GridSampling& sampling) {
  return {{"filter", filter.name},
          {"method", method},
          {"per_sigma_s", sampling.per_sigma_s},
          {"per_sigma_value", sampling.per_sigma_value},
          {"per_sigma_d", sampling.per_sigma_d}};
}

void set_error(SweepOutcome& outcome, const Plane<float>& base, const Plane<float>& exact) {
  DifferenceSum difference;
  difference.add(base, exact);
  outcome.error = difference.rms();
  outcome.values = {{"rms_error", difference.rms(), "log10 units"},
                    {"max_error", difference.largest(), "log10 units"}};
}

/// The exact filter takes long: it runs once, and that run is timed.
SweepOutcome run_exactly(const FilterCase& filter, Plane<float>& exact) {
  SweepOutcome outcome{.setting = columns_of(filter, "exact", {0, 0, 0})};
  const Stopwatch watch;
  exact = filter_exactly(filter.input());
  outcome.timing = summarise_times({watch.seconds()});
  set_error(outcome, exact, exact);
  return outcome;
}

std::optional<SweepOutcome> run_grid(const FilterCase& filter, const GridSampling& sampling,
                                     const Plane<float>& exact, int runs) {
  const std::optional<Plane<float>> base = filter_by_grid(filter.input(), sampling);
  if (!base) return std::nullopt;
  SweepOutcome outcome{.setting = columns_of(filter, "grid", sampling)};
  set_error(outcome, *base, exact);
  time_setting(
      outcome, [&] { filter_by_grid(filter.input(), sampling); }, runs);
  return outcome;
}

std::vector<FilterCase> cases_of(const SweepImage& image, const Plane<float>& logs, int threads) {
  const BilateralToneOptions tone;
  const BilateralOptions widths{.sigma_s_px = tone.sigma_s_share * std::max(logs.width(), logs.height()),
                                .sigma_value = tone.sigma_log10};
  std::vector<FilterCase> cases{{"naive", logs, widths, std::nullopt, threads}};
  if (image.view.disparity)
    cases.push_back(
        {"enhanced", logs, widths, DepthGuide{image.view.disparity.get(), tone.sigma_d_px}, threads});
  return cases;
}

}  // namespace

std::vector<GridSampling> all_grid_samplings() {
  std::vector<GridSampling> samplings;
  for (const double per_sigma_value : {2.0, 4.0, 6.0})
    for (const double per_sigma_s : {1.0, 2.0, 3.0, 4.0, 6.0})
      samplings.push_back({.per_sigma_s = per_sigma_s, .per_sigma_value = per_sigma_value});
  return samplings;
}

ResultTable sweep_bilateral(const SweepImage& image, const std::vector<GridSampling>& samplings,
                            const SweepRun& run) {
  const double floor = log_floor(measure_view(*image.view.colour, run.threads));
  const Plane<float> logs =
      bilateral_layers({}, *image.view.colour, nullptr, floor, run.threads).log_luminance;
  const std::vector<FilterCase> cases = cases_of(image, logs, run.threads);
  const double steps = static_cast<double>(cases.size() * (samplings.size() + 1));
  double done = 0;
  ResultTable table;
  for (const FilterCase& filter : cases) {
    Plane<float> exact;
    std::vector<SweepOutcome> outcomes{run_exactly(filter, exact)};
    if (run.progress) run.progress(++done / steps);
    for (const GridSampling& sampling : samplings) {
      if (auto outcome = run_grid(filter, sampling, exact, run.runs)) outcomes.push_back(std::move(*outcome));
      if (run.progress) run.progress(++done / steps);
    }
    add_outcome_rows(table, {{"image", image.name}}, outcomes);
  }
  return table;
}

SweepPlotDesign bilateral_sweep_plot() {
  return {"rms_error",
          "RMS error of the base layer",
          "log10 units",
          {"filter", "per_sigma_value"},
          "per_sigma_s"};
}

}  // namespace plenolab
