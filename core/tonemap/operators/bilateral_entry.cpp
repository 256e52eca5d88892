#include <utility>

#include "core/tonemap/bilateral.h"
#include "core/tonemap/operators/entries.h"

namespace plenolab {

namespace {

const std::vector<Setting>& settings() {
  static const BilateralToneOptions d;
  static const std::vector<Setting> table{
      {"sigma_s", d.sigma_s_share, 1e-4, 1, "of the larger side", "width of the filter in the image"},
      {"sigma_l", d.sigma_log10, 1e-3, 100, "log10 units", "width of the filter in luminance"},
      {"sigma_d", d.sigma_d_px, 1e-3, 1e6, "px of disparity", "width of the filter in disparity (enhanced)"},
      {"contrast", d.contrast, 1.1, 1e6, "", "of all bases on the display, for automatic compression"},
      {.name = "compression",
       .default_value = 0.5,
       .minimum = 1e-3,
       .maximum = 1,
       .help = "factor on the log base layer",
       .automatic = "min(1, log10 contrast / range of all bases without outliers)"},
      {.name = "brightness",
       .default_value = 0,
       .minimum = -100,
       .maximum = 100,
       .unit = "log10 units",
       .help = "subtracted from the log result",
       .automatic = "compression times the upper end of the range of bases without outliers"},
      {.name = "foreground",
       .default_value = 0.5,
       .minimum = 0,
       .maximum = 4,
       .help = "factor on the log foreground layer (enhanced)",
       .automatic = "1 - compression"},
      {"outliers", d.outliers, 0, 0.2, "",
       "share of bases left out at each end of their range; 0 = extremes"},
      {.name = "alpha",
       .default_value = 1 / 2.2,
       .minimum = 0,
       .maximum = 1,
       .help = "exponent of the colour ratio: 1 saturated, 0 grey",
       .automatic = "less with stronger compression, from 1/2.2 down (Mantiuk et al. 2009)"},
      {.name = "filter",
       .default_value = 0,
       .minimum = 0,
       .maximum = 1,
       .help = "fast approximation, or the exact filter, which is slow",
       .choices = {"fast", "exact"}},
  };
  return table;
}

BaseRange base_range(const BilateralToneOptions& options, const FitScope& scope) {
  const auto measure = [&](int i) {
    const OperatorView view = scope.load(i);
    return measure_base(
        bilateral_layers(options, *view.colour, view.disparity.get(), scope.floor, scope.threads, false));
  };
  BaseHistogram all = measure(0);
  for (int i = 1; i < scope.views; ++i) all = merge(std::move(all), measure(i));
  return range_of(all, options.outliers);
}

FittedOperator fit_entry(std::string_view variant, const SettingValues& values, const FitScope& scope) {
  const BilateralToneOptions options = bilateral_options(variant, values);
  // Bases are only looked at where something depends on them.
  const bool automatic = !options.compression || !options.brightness;
  const BaseRange bases = automatic ? base_range(options, scope) : BaseRange{};
  const BilateralToneParameters p = fit(options, bases, scope.floor);
  return keep_black({[p](const OperatorView& view, int threads) {
                       return apply(p, *view.colour, view.disparity.get(), threads);
                     },
                     {{"compression", p.compression, ""},
                      {"brightness", p.brightness, "log10 units"},
                      {"foreground_scale", p.foreground_scale, ""},
                      {"colour_exponent", p.colour_exponent, ""}},
                     {}},
                    scope);
}

}  // namespace

BilateralToneOptions bilateral_options(std::string_view variant, const SettingValues& values) {
  BilateralToneOptions o;
  o.enhanced = variant == "enhanced";
  o.exact = number(settings(), values, "filter") == 1;
  o.sigma_s_share = number(settings(), values, "sigma_s");
  o.sigma_log10 = number(settings(), values, "sigma_l");
  o.sigma_d_px = number(settings(), values, "sigma_d");
  o.contrast = number(settings(), values, "contrast");
  o.compression = number_unless_automatic(settings(), values, "compression");
  o.brightness = number_unless_automatic(settings(), values, "brightness");
  o.foreground_scale = number_unless_automatic(settings(), values, "foreground");
  o.outliers = number(settings(), values, "outliers");
  o.colour_exponent = number_unless_automatic(settings(), values, "alpha");
  return o;
}

OperatorInfo bilateral_entry() {
  return {.id = "bilateral",
          .title = "Bilateral filtering",
          .description = "compressed base layer, untouched detail layer",
          .source = "Durand & Dorsey 2002; thesis of Altmeier, sections 5.1.2 and 5.1.3",
          .input_unit = "any",
          .settings = settings(),
          .variants = {{"naive", OperatorScope::kLightField, false, "layers of luminance"},
                       {"enhanced", OperatorScope::kLightField, true,
                        "no profiles across depth edges, half profiles on the foreground"}},
          .fit = fit_entry,
          .map_frame = {}};
}

}  // namespace plenolab
