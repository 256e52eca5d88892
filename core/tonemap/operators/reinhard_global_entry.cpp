#include "core/tonemap/operators/entries.h"
#include "core/tonemap/reinhard_global.h"

namespace plenolab {

namespace {

const std::vector<Setting>& settings() {
  static const std::vector<Setting> table{
      {.name = "key",
       .default_value = 0.18,
       .minimum = 0.001,
       .maximum = 4,
       .help = "display luminance of the log average",
       .automatic = "from the percentiles of luminance"},
      {.name = "white",
       .default_value = 4,
       .minimum = 0.01,
       .maximum = 1e9,
       .help = "smallest scaled luminance shown as white",
       .automatic = "none: white is never reached"},
      colour_exponent_setting(1 / 2.2),
  };
  return table;
}

ReinhardGlobalOptions options_of(const SettingValues& values) {
  ReinhardGlobalOptions o;
  const std::optional<double> key = number_unless_automatic(settings(), values, "key");
  o.automatic_key = !key;
  o.key = key.value_or(o.key);
  const std::optional<double> white = number_unless_automatic(settings(), values, "white");
  o.white_point = white.has_value();
  o.white = white.value_or(o.white);
  o.colour_exponent = number(settings(), values, "alpha");
  return o;
}

std::vector<FittedValue> report(const ReinhardGlobalParameters& p) {
  return {{"key", p.key, ""}, {"log_average", p.log_average, "log10 units"}};
}

FittedOperator fit_entry(std::string_view, const SettingValues& values, const FitScope& scope) {
  const ReinhardGlobalParameters p = fit(options_of(values), scope.statistics);
  return {
      [p](const OperatorView& view, int threads) { return apply(p, *view.colour, threads); }, report(p), {}};
}

MappedFrame map_entry(std::string_view, const SettingValues& values, const FrameInput& frame,
                      const std::optional<FrameState>& previous) {
  FrameState state;
  state.statistics = follow_statistics(frame, previous);
  const ReinhardGlobalParameters p = fit(options_of(values), state.statistics.value);
  return {apply(p, *frame.view, frame.threads), state, report(p)};
}

}  // namespace

OperatorInfo reinhard_global_entry() {
  return {.id = "reinhard02",
          .title = "Reinhard 2002, global",
          .description = "photographic curve with an automatic key",
          .source = "Reinhard et al. 2002, equations 1-4; Reinhard 2003",
          .input_unit = "any",
          .settings = settings(),
          .variants = {{"naive", OperatorScope::kView, false, "statistics of each view"},
                       {"joint", OperatorScope::kLightField, false, "statistics of all views"},
                       {"interpolate-statistics", OperatorScope::kFrame, false,
                        "frames, with statistics of key views blended and adapted in time"}},
          .fit = fit_entry,
          .map_frame = map_entry};
}

}  // namespace plenolab
