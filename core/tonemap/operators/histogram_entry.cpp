#include "core/tonemap/histogram_adjustment.h"
#include "core/tonemap/operators/entries.h"

namespace plenolab {

namespace {

/// Log average that relative radiance is given: that of a lit interior, bright enough that the eye sees
/// contrasts and not differences (so a brighter one changes little).
constexpr double kLogAverage_cd_m2 = 100;

const std::vector<Setting>& settings() {
  static const HistogramOptions d;
  static const std::vector<Setting> table{
      {.name = "ceiling",
       .default_value = 0,
       .minimum = 0,
       .maximum = 3,
       .help = "limit of the slope: visibility as in the scene, contrast as in the scene, or the thesis' "
               "formulas",
       .choices = {"perceptual", "linear", "as-printed", "linear-as-printed"}},
      {.name = "bins",
       .default_value = static_cast<double>(d.bins),
       .minimum = 2,
       .maximum = 65536,
       .help = "bins of the histogram",
       .integer = true},
      {"tolerance", d.tolerance, 1e-6, 0.5, "",
       "trimming ends when a pass trims at most this share of the pixels"},
      {.name = "passes",
       .default_value = 4,
       .minimum = 0,
       .maximum = 1000,
       .help = "number of trimming passes",
       .integer = true,
       .automatic = "until the tolerance is met"},
      {"display_max", d.display_max_cd_m2, 0.01, 1e6, "cd/m2", "brightest luminance of the display"},
      {"display_min", d.display_min_cd_m2, 1e-6, 1e5, "cd/m2", "darkest luminance of the display"},
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

HistogramOptions options_of(const SettingValues& values, const RadianceScale& scale) {
  HistogramOptions o;
  o.ceiling = static_cast<HistogramCeiling>(static_cast<int>(number(settings(), values, "ceiling")));
  o.bins = static_cast<int>(number(settings(), values, "bins"));
  o.tolerance = number(settings(), values, "tolerance");
  if (const auto passes = number_unless_automatic(settings(), values, "passes"))
    o.fixed_passes = static_cast<int>(*passes);
  o.display_max_cd_m2 = number(settings(), values, "display_max");
  o.display_min_cd_m2 = number(settings(), values, "display_min");
  o.colour_exponent = number(settings(), values, "alpha");
  o.cd_m2_per_unit =
      number_unless_automatic(settings(), values, "unit").value_or(scale.to_cd_m2(kLogAverage_cd_m2));
  o.validate();
  return o;
}

LogHistogram histogram_of_scope(const HistogramOptions& options, const FitScope& scope) {
  const auto measure = [&](int view) {
    return measure_histogram(*scope.load(view).colour, scope.floor, scope.statistics.log_min,
                             scope.statistics.log_max, options.bins, scope.threads);
  };
  // A range that fits the display is mapped linearly whatever the histogram, so no view is read for it.
  if (fits_display(options, scope.statistics.log_min, scope.statistics.log_max))
    return {scope.statistics.log_min, scope.statistics.log_max,
            std::vector<double>(static_cast<std::size_t>(options.bins), 0.0)};
  LogHistogram all = measure(0);
  for (int i = 1; i < scope.views; ++i) all = merge(all, measure(i));
  return all;
}

FittedOperator fit_entry(std::string_view, const SettingValues& values, const FitScope& scope) {
  const HistogramOptions options = options_of(values, scope.scale);
  const HistogramParameters p = fit(options, histogram_of_scope(options, scope), scope.floor);
  const double initial = p.passes.empty() ? 1 : p.passes.front().total;
  const double left = p.passes.empty() ? 1 : p.passes.back().total - p.passes.back().trimmed;
  FittedOperator fitted{
      [p](const OperatorView& view, int threads) { return apply(p, *view.colour, threads); },
      {{"trimming_passes", static_cast<double>(p.passes.size()), ""},
       {"histogram_left", left / initial, "share"},
       {"linear", p.linear ? 1.0 : 0.0, ""},
       {"cd_m2_per_unit", options.cd_m2_per_unit, "cd/m2"}},
      {}};
  if (p.linear) fitted.notes.push_back("linear mapping: " + p.linear_because);
  return keep_black(std::move(fitted), scope);
}

}  // namespace

OperatorInfo histogram_entry() {
  return {.id = "histogram",
          .title = "Histogram adjustment",
          .description = "equalised histogram with a ceiling that follows visibility",
          .source = "Ward Larson, Rushmeier & Piatko 1997; thesis of Altmeier, section 5.1.4",
          .input_unit = "cd/m2",
          .settings = settings(),
          .variants = {{"naive", OperatorScope::kView, false, "histogram of each view"},
                       {"joint", OperatorScope::kLightField, false, "histogram of all views"}},
          .fit = fit_entry,
          .map_frame = {}};
}

}  // namespace plenolab
