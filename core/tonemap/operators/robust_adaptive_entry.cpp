#include <cmath>

#include "core/tonemap/eye_average.h"
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
      {"glare", d.glare, 0, 0.5, "log10 units", "dimming for each decade of light at the eye"},
      colour_exponent_setting(d.colour_exponent),
  };
  return table;
}

RobustAdaptiveOptions options_of(const SettingValues& values) {
  return {.brightness = number(settings(), values, "b"),
          .colour_adaptation = number(settings(), values, "c"),
          .light_adaptation = number(settings(), values, "l"),
          .toe = number(settings(), values, "toe"),
          .shoulder = number(settings(), values, "shoulder"),
          .max_slope = number(settings(), values, "max_slope"),
          .colour_exponent = number(settings(), values, "alpha"),
          .glare = number(settings(), values, "glare")};
}

std::vector<FittedValue> report(const RobustAdaptiveParameters& p) {
  return {{"contrast", p.receptor.contrast, ""}, {"exposure", p.receptor.exposure, "1/unit"},
          {"response_p1", p.knot_low, ""},       {"response_p99", p.knot_high, ""},
          {"luma_p1", p.luma_low, "luma"},       {"luma_p99", p.luma_high, "luma"},
          {"dimming", p.dimming, "log10 units"}};
}

/// Of all views of a scope together, which have one size.
double log_eye_average_of(const FitScope& scope) {
  double sum = 0;
  for (int i = 0; i < scope.views; ++i) sum += eye_average(*scope.load(i).colour, scope.threads);
  return log_eye_average(sum / scope.views, scope.statistics);
}

FittedOperator fit_entry(std::string_view, const SettingValues& values, const FitScope& scope) {
  const RobustAdaptiveOptions options = options_of(values);
  const double eye = options.glare > 0 ? log_eye_average_of(scope) : scope.statistics.log_robust_average;
  const RobustAdaptiveParameters p = fit(options, scope.statistics, eye);
  return {
      [p](const OperatorView& view, int threads) { return apply(p, *view.colour, threads); }, report(p), {}};
}

MappedFrame map_entry(std::string_view, const SettingValues& values, const FrameInput& frame,
                      const std::optional<FrameState>& previous) {
  FrameState state;
  state.statistics = follow_statistics(frame, previous);
  const ImageStatistics& statistics = state.statistics.value;
  state.log_eye_average =
      adapt(frame.adaptation, previous ? std::optional(previous->log_eye_average) : std::nullopt,
            log_eye_average(eye_average(*frame.view, frame.threads), statistics), frame.step_s);
  const RobustAdaptiveParameters p = fit(options_of(values), statistics, state.log_eye_average.value);
  return {apply(p, *frame.view, frame.threads), state, report(p)};
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
          .fit = fit_entry,
          .map_frame = map_entry};
}

}  // namespace plenolab
