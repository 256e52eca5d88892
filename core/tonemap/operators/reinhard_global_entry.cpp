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

}  // namespace

OperatorInfo reinhard_global_entry() {
  return {.id = "reinhard02",
          .title = "Reinhard 2002, global",
          .description = "photographic curve with an automatic key",
          .source = "Reinhard et al. 2002, equations 1-4; Reinhard 2003",
          .input_unit = "any",
          .settings = settings(),
          .variants = statistics_variants(),
          .fit = fit_to_statistics<options_of, report>,
          .map_frame = map_by_statistics<options_of, report>};
}

}  // namespace plenolab
