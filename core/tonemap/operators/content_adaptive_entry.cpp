#include <algorithm>
#include <cmath>

#include "core/tonemap/content_adaptive.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/operators/entries.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

/// Log average that relative radiance is given: that of a lit interior.
constexpr double kLogAverage_cd_m2 = 100;

const std::vector<Setting>& settings() {
  static const ContentAdaptiveOptions d;
  static const std::vector<Setting> table{
      {"key", d.key, 0.001, 4, "", "display luminance of the log average"},
      {"kappa", d.kappa, 0, 1, "", "bound on the slopes of bins with few pixels"},
      {.name = "slope_cap",
       .default_value = 16,
       .minimum = 1,
       .maximum = 1e6,
       .help = "most that the slope of a bin may rise to, times the photographic curve's",
       .automatic = "none"},
      colour_exponent_setting(d.colour_exponent),
      {.name = "unit",
       .default_value = d.cd_m2_per_unit,
       .minimum = 1e-12,
       .maximum = 1e12,
       .unit = "cd/m2",
       .help = "luminance of radiance 1",
       .automatic = "as declared; relative radiance: so that the log average is 100 cd/m2"},
  };
  return table;
}

ContentAdaptiveOptions options_of(const SettingValues& values, const RadianceScale& scale) {
  ContentAdaptiveOptions o;
  o.key = number(settings(), values, "key");
  o.kappa = number(settings(), values, "kappa");
  o.slope_cap = number_unless_automatic(settings(), values, "slope_cap");
  o.colour_exponent = number(settings(), values, "alpha");
  o.cd_m2_per_unit =
      number_unless_automatic(settings(), values, "unit").value_or(scale.to_cd_m2(kLogAverage_cd_m2));
  return o;
}

/// Luminance in cd/m², within float.
Plane<float> luminance_of(const SceneImage& view, double cd_m2_per_unit, int threads) {
  const RepairedView repaired(view, threads);
  Plane<float> result(view.width(), view.height());
  luminance_row(repaired.image().pixels(), result.pixels());
  for (float& v : result.pixels())
    v = static_cast<float>(std::min(static_cast<double>(v) * cd_m2_per_unit, 1e30));
  return result;
}

PqHistogram histogram_of_scope(const ContentAdaptiveOptions& options, const FitScope& scope) {
  const double largest = std::pow(10, scope.statistics.log_max) * options.cd_m2_per_unit;
  const auto measure = [&](int view) {
    return measure_pq_histogram(luminance_of(*scope.load(view).colour, options.cd_m2_per_unit, scope.threads),
                                largest, scope.threads);
  };
  PqHistogram all = measure(0);
  for (int i = 1; i < scope.views; ++i) all = merge(all, measure(i));
  return all;
}

FittedOperator fit_entry(std::string_view, const SettingValues& values, const FitScope& scope) {
  const ContentAdaptiveOptions options = options_of(values, scope.scale);
  const ContentAdaptiveParameters p = fit(options, histogram_of_scope(options, scope));
  FittedOperator fitted{
      [p](const OperatorView& view, int threads) { return apply(p, *view.colour, threads); },
      {{"heavy_bins", static_cast<double>(p.curve.heavy_bins), "bins"},
       {"capped_bins", static_cast<double>(p.curve.capped_bins), "bins"},
       {"largest_rise", p.curve.largest_rise, ""},
       {"cd_m2_per_unit", options.cd_m2_per_unit, "cd/m2"}},
      {}};
  if (!p.curve.plain.empty()) fitted.notes.push_back("photographic curve: " + p.curve.plain);
  if (p.curve.capped_bins > 0) fitted.notes.push_back("the slope cap holds some bins back");
  return keep_black(std::move(fitted), scope);
}

}  // namespace

OperatorInfo content_adaptive_entry() {
  return {.id = "content-adaptive",
          .title = "Content adaptive",
          .description = "photographic curve that gives slope to where pixels are",
          .source = "Khaldieh et al. 2018; thesis of Zhao, chapter 3",
          .input_unit = "cd/m2",
          .settings = settings(),
          .variants = {{"naive", OperatorScope::kView, false, "histogram of each view"},
                       {"joint", OperatorScope::kLightField, false, "histogram of all views"}},
          .fit = fit_entry,
          .map_frame = {}};
}

}  // namespace plenolab
