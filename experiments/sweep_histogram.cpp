#include "core/tonemap/histogram_adjustment.h"
#include "experiments/sweep_errors.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

namespace {

constexpr int kMostBins = 65536;

struct MappedByHistogram {
  DisplayImage image;
  std::size_t passes = 0;
};

MappedByHistogram map_with(int bins, const SceneImage& view, int threads) {
  HistogramOptions options;
  options.bins = bins;
  options.colour_exponent = 0;  // luma alone
  const ViewStatistics statistics = measure_view(view, threads);
  const double floor = log_floor(statistics);
  const ImageStatistics numbers = evaluate(statistics, floor);
  const HistogramParameters parameters =
      fit(options, measure_histogram(view, floor, numbers.log_min, numbers.log_max, bins, threads), floor);
  return {apply(parameters, view, threads).image, parameters.passes.size()};
}

}  // namespace

std::vector<int> all_bin_numbers() {
  return {16, 64, 256, 1024, 4096, 16384, kMostBins};
}

ResultTable sweep_histogram(const SweepImage& image, const std::vector<int>& bins, const SweepRun& run) {
  const SceneImage& view = *image.view.colour;
  const DisplayImage reference = map_with(kMostBins, view, run.threads).image;
  std::vector<SweepOutcome> outcomes;
  for (const int number : bins) {
    SweepOutcome& outcome = outcomes.emplace_back();
    outcome.setting = {{"bins", static_cast<long long>(number)}};
    const MappedByHistogram mapped = map_with(number, view, run.threads);
    DifferenceSum difference;
    difference.add(mapped.image, reference);
    outcome.error = difference.rms();
    outcome.values = {{"rms_error", difference.rms(), "luma"},
                      {"max_error", difference.largest(), "luma"},
                      {"trimming_passes", static_cast<double>(mapped.passes), "passes"}};
    time_setting(
        outcome, [&] { map_with(number, view, run.threads); }, run.runs);
    if (run.progress) run.progress(static_cast<double>(outcomes.size()) / static_cast<double>(bins.size()));
  }
  ResultTable table;
  add_outcome_rows(table, {{"image", image.name}}, outcomes);
  return table;
}

SweepPlotDesign histogram_sweep_plot() {
  return {"rms_error", "RMS error of luma", "1", {"image"}, "bins"};
}

}  // namespace plenolab
