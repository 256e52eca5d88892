#include "core/tonemap/operators/entries.h"
#include "core/tonemap/robust_adaptive.h"

namespace plenolab {

namespace {

const std::vector<Setting>& settings() {
  static const RobustAdaptiveOptions d;
  static const std::vector<Setting> table{
      {"b", d.brightness, -8, 8, "", "brightness of the middle tones"},
      {"c", d.colour_adaptation, 0, 1, "", "adaptation of each channel to itself"},
      {"l", d.light_adaptation, 0, 1, "", "adaptation to the pixel (1) or the view (0)"},
      {"toe", d.toe, 0, 0.4, "luma", "luma of the first percentile of luminance"},
      {"shoulder", d.shoulder, 0, 0.4, "luma", "luma kept for what is above the 99th percentile"},
      {"max_slope", d.max_slope, 0.05, 10, "luma per log10 unit",
       "largest mean slope between the percentiles"},
  };
  return table;
}

RobustAdaptiveOptions options_of(const SettingValues& values) {
  return {.brightness = number(settings(), values, "b"),
          .colour_adaptation = number(settings(), values, "c"),
          .light_adaptation = number(settings(), values, "l"),
          .toe = number(settings(), values, "toe"),
          .shoulder = number(settings(), values, "shoulder"),
          .max_slope = number(settings(), values, "max_slope")};
}

std::vector<FittedValue> report(const RobustAdaptiveParameters& p) {
  return {{"contrast", p.receptor.contrast, ""}, {"exposure", p.receptor.exposure, "1/unit"},
          {"response_p1", p.knot_low, ""},       {"response_p99", p.knot_high, ""},
          {"luma_p1", p.luma_low, "luma"},       {"luma_p99", p.luma_high, "luma"}};
}

}  // namespace

OperatorInfo robust_adaptive_entry() {
  return {.id = "robust",
          .title = "Robust adaptive",
          .description = "photoreceptor curve steered by percentiles, with adaptation in time",
          .source = "this program, after Reinhard & Devlin 2005",
          .input_unit = "any",
          .settings = settings(),
          .variants = statistics_variants(),
          .fit = fit_to_statistics<options_of, report>,
          .map_frame = map_by_statistics<options_of, report>};
}

}  // namespace plenolab
