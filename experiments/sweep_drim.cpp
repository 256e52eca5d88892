#include "experiments/sweep_drim.h"

#include <algorithm>
#include <cmath>

#include "experiments/tonemap_fit.h"
#include "metrics/drim.h"

namespace plenolab {

namespace {

constexpr DrimSetting kFull{1, 6};

/// Mean of blocks of divisor × divisor pixels, those at the right and lower border smaller.
Plane<float> averaged(const Plane<float>& image, int divisor) {
  Plane<float> small((image.width() + divisor - 1) / divisor, (image.height() + divisor - 1) / divisor);
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      const int right = std::min((x + 1) * divisor, image.width());
      const int below = std::min((y + 1) * divisor, image.height());
      double sum = 0;
      for (int v = y * divisor; v < below; ++v)
        for (int u = x * divisor; u < right; ++u) sum += static_cast<double>(image.at(u, v));
      small.at(x, y) = static_cast<float>(sum / ((right - x * divisor) * (below - y * divisor)));
    }
  }
  return small;
}

struct LuminancePair {
  Plane<float> test, reference;
};

DrimMaps maps_with(const DrimSetting& setting, const LuminancePair& pair, int threads) {
  ViewingConditions viewing;
  viewing.pixels_per_degree /= setting.divisor;
  DrimOptions options;
  options.orientations = setting.orientations;
  options.bands -= static_cast<int>(std::lround(std::log2(setting.divisor)));
  if (setting.divisor == 1) return drim_maps(pair.test, pair.reference, viewing, options, threads);
  return drim_maps(averaged(pair.test, setting.divisor), averaged(pair.reference, setting.divisor), viewing,
                   options, threads);
}

/// Sums of differences of probabilities; pixels of `maps` stand for `divisor` pixels of `full`.
struct MapDifference {
  double absolute = 0, squares = 0, count = 0;
  void add(const Plane<float>& map, const Plane<float>& full, int divisor) {
    for (int y = 0; y < full.height(); ++y) {
      for (int x = 0; x < full.width(); ++x) {
        const double d =
            static_cast<double>(map.at(x / divisor, y / divisor)) - static_cast<double>(full.at(x, y));
        absolute += std::abs(d);
        squares += d * d;
        ++count;
      }
    }
  }
};

std::vector<Measurement> values_of(const DrimMaps& maps, const DrimMaps& full, int divisor) {
  MapDifference difference;
  difference.add(maps.loss, full.loss, divisor);
  difference.add(maps.amplification, full.amplification, divisor);
  difference.add(maps.reversal, full.reversal, divisor);
  std::vector<Measurement> values{{"mean_error", difference.absolute / difference.count, "1"},
                                  {"rms_error", std::sqrt(difference.squares / difference.count), "1"}};
  for (const Measurement& m : drim_measurements(maps))
    if (m.quantity == "drim_share_any" || m.quantity == "drim_mean_total") values.push_back(m);
  return values;
}

}  // namespace

std::vector<DrimSetting> all_drim_settings() {
  std::vector<DrimSetting> settings;
  for (const int divisor : {1, 2, 4})
    for (const int orientations : {1, 2, 3, 4, 6}) settings.push_back({divisor, orientations});
  return settings;
}

ResultTable sweep_drim(const SweepImage& image, double cd_m2_per_unit, const OperatorChoice& choice,
                       const std::vector<DrimSetting>& settings, const SweepRun& run) {
  const FittedOperator fitted = fit_image(choice, image.view, cd_m2_per_unit, run.threads);
  const LuminancePair pair{displayed_luminance(fitted.apply(image.view, run.threads).image, {}),
                           scene_luminance(*image.view.colour, cd_m2_per_unit)};
  const DrimMaps full = maps_with(kFull, pair, run.threads);
  std::vector<SweepOutcome> outcomes;
  for (const DrimSetting& setting : settings) {
    SweepOutcome& outcome = outcomes.emplace_back();
    outcome.setting = {{"divisor", static_cast<long long>(setting.divisor)},
                       {"orientations", static_cast<long long>(setting.orientations)}};
    outcome.values = values_of(maps_with(setting, pair, run.threads), full, setting.divisor);
    outcome.error = outcome.values.front().value;
    time_setting(
        outcome, [&] { maps_with(setting, pair, run.threads); }, run.runs);
    if (run.progress)
      run.progress(static_cast<double>(outcomes.size()) / static_cast<double>(settings.size()));
  }
  ResultTable table;
  add_outcome_rows(table, {{"image", image.name}}, outcomes);
  return table;
}

SweepPlotDesign drim_sweep_plot() {
  return {"mean_error", "Mean error of probabilities", "1", {"divisor"}, "orientations"};
}

}  // namespace plenolab
