#include "core/tonemap/operators/entries.h"
#include "core/tonemap/reinhard_devlin.h"

namespace plenolab {

namespace {

/// Log average that relative radiance is given: where the response is one half whatever the contrast m, and
/// so the result of b = 0 neither dark nor bright.
constexpr double kLogAverage_cd_m2 = 1;

enum class LimitKind { kMeasured, kManual, kNone };

const std::vector<Setting>& settings() {
  static const ReinhardDevlinOptions d;
  static const std::vector<Setting> table{
      {"b", d.brightness, -8, 8, "", "brightness"},
      {"c", d.colour_adaptation, 0, 1, "", "adaptation of each channel to itself"},
      {"l", d.light_adaptation, 0, 1, "", "adaptation to the pixel (1) or the view (0)"},
      {.name = "m",
       .default_value = 0.6,
       .minimum = 0.1,
       .maximum = 1,
       .help = "contrast, the exponent of the adaptation level",
       .automatic = "from the extremes and the log average of luminance"},
      {.name = "exposure",
       .default_value = d.exposure,
       .minimum = 1e-9,
       .maximum = 1e9,
       .unit = "cd/m2",
       .help = "factor on the radiance: luminance of radiance 1",
       .automatic = "as declared; relative radiance: so that the log average is 1 cd/m2"},
      {.name = "limits",
       .default_value = 0,
       .minimum = 0,
       .maximum = 2,
       .help = "luma limits of the normalisation: extremes of the output, luma_min and luma_max, or none",
       .choices = {"measured", "manual", "none"}},
      {"luma_min", 0, 0, 1, "luma", "lower limit if limits=manual"},
      {"luma_max", 1, 0, 1, "luma", "upper limit if limits=manual"},
  };
  return table;
}

ReinhardDevlinOptions options_of(const SettingValues& values, const RadianceScale& scale) {
  ReinhardDevlinOptions o;
  o.brightness = number(settings(), values, "b");
  o.colour_adaptation = number(settings(), values, "c");
  o.light_adaptation = number(settings(), values, "l");
  o.contrast = number_unless_automatic(settings(), values, "m");
  o.exposure =
      number_unless_automatic(settings(), values, "exposure").value_or(scale.to_cd_m2(kLogAverage_cd_m2));
  return o;
}

LimitKind limit_kind(const SettingValues& values) {
  return static_cast<LimitKind>(static_cast<int>(number(settings(), values, "limits")));
}

/// The limits that do not depend on any output, if the settings ask for such.
std::optional<LumaLimits> fixed_limits(const SettingValues& values) {
  if (limit_kind(values) == LimitKind::kMeasured) return std::nullopt;
  if (limit_kind(values) == LimitKind::kNone) return LumaLimits{0, 1};
  const LumaLimits manual{number(settings(), values, "luma_min"), number(settings(), values, "luma_max")};
  validate(manual);
  return manual;
}

LumaLimits limits_of_scope(const ReinhardDevlinParameters& p, const FitScope& scope) {
  LumaLimits all = measure_limits(p, *scope.load(0).colour, scope.threads);
  for (int i = 1; i < scope.views; ++i)
    all = enclose(all, measure_limits(p, *scope.load(i).colour, scope.threads));
  return all;
}

std::vector<FittedValue> report(double contrast, double exposure, const LumaLimits& limits) {
  return {{"contrast", contrast, ""},
          {"exposure", exposure, "cd/m2"},
          {"luma_min", limits.min, "luma"},
          {"luma_max", limits.max, "luma"}};
}

FittedOperator fit_entry(std::string_view, const SettingValues& values, const FitScope& scope) {
  const ReinhardDevlinParameters p = fit(options_of(values, scope.scale), scope.statistics);
  const std::optional<LumaLimits> fixed = fixed_limits(values);
  const LumaLimits limits = fixed ? *fixed : limits_of_scope(p, scope);
  FittedOperator fitted{
      [p, limits](const OperatorView& view, int threads) { return apply(p, limits, *view.colour, threads); },
      report(p.contrast, p.exposure, limits),
      {}};
  if (!(limits.max > limits.min))
    fitted.notes.push_back("luma has no range to normalise: the response is shown as it is");
  return fitted;
}

/// The thesis' section 5.2.1: results of the key views' mappings blended; limits of this frame.
MappedFrame map_interpolating_results(const SettingValues& values, const FrameInput& frame) {
  std::vector<ReinhardDevlinParameters> parameters;
  double contrast = 0;
  for (std::size_t i = 0; i < frame.key_views.size(); ++i) {
    parameters.push_back(fit(options_of(values, frame.scale), frame.key_views[i]));
    contrast += frame.weights.at(i) * parameters.back().contrast;
  }
  Response response = respond_interpolated(parameters, frame.weights, *frame.view, frame.threads);
  const std::optional<LumaLimits> fixed = fixed_limits(values);
  const LumaLimits limits = fixed.value_or(response.limits);
  return {normalise(std::move(response), limits, frame.threads),
          {},
          report(contrast, parameters.front().exposure, limits)};
}

/// The thesis' section 5.2.2: statistics blended, the limits of this frame, both adapted in time.
MappedFrame map_interpolating_statistics(const SettingValues& values, const FrameInput& frame,
                                         const std::optional<FrameState>& previous) {
  MappedFrame result;
  result.state.statistics = follow_statistics(frame, previous);
  const ReinhardDevlinParameters p = fit(options_of(values, frame.scale), result.state.statistics.value);
  Response response = respond(p, *frame.view, frame.threads);
  const std::optional<LumaLimits> fixed = fixed_limits(values);
  const LumaLimits now = fixed.value_or(response.limits);
  const auto follow = [&](Adapted<double> FrameState::*limit, double target) {
    return adapt(frame.adaptation, previous ? std::optional((*previous).*limit) : std::nullopt, target,
                 frame.step_s);
  };
  result.state.limit_min = follow(&FrameState::limit_min, now.min);
  result.state.limit_max = follow(&FrameState::limit_max, now.max);
  const LumaLimits limits{result.state.limit_min.value, result.state.limit_max.value};
  result.mapped = normalise(std::move(response), limits, frame.threads);
  result.values = report(p.contrast, p.exposure, limits);
  return result;
}

MappedFrame map_entry(std::string_view variant, const SettingValues& values, const FrameInput& frame,
                      const std::optional<FrameState>& previous) {
  return variant == "interpolate-results" ? map_interpolating_results(values, frame)
                                          : map_interpolating_statistics(values, frame, previous);
}

}  // namespace

OperatorInfo reinhard_devlin_entry() {
  return {
      .id = "reinhard05",
      .title = "Reinhard & Devlin 2005",
      .description = "photoreceptor curve normalised to the extremes of luma",
      .source = "Reinhard & Devlin 2005; thesis of Altmeier, sections 5.1.5, 5.1.6 and 5.2",
      .input_unit = "cd/m2",
      .settings = settings(),
      .variants =
          {{"naive", OperatorScope::kView, false, "statistics and limits of each view"},
           {"joint", OperatorScope::kLightField, false, "statistics and limits of all views"},
           {"interpolate-results", OperatorScope::kFrame, false,
            "frames, mapped with the statistics of each near key view and blended"},
           {"interpolate-statistics", OperatorScope::kFrame, false,
            "frames, with statistics of key views blended and limits of the frame, both adapted in time"}},
      .fit = fit_entry,
      .map_frame = map_entry};
}

}  // namespace plenolab
