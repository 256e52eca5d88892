#include "core/tonemap/operators/entries.h"
#include "core/tonemap/pq_operator.h"

namespace plenolab {

namespace {

/// Log average that relative radiance is given: as for histogram adjustment, a lit interior.
constexpr double kLogAverage_cd_m2 = 100;

const std::vector<Setting>& settings() {
  static const PqOptions d;
  static const std::vector<Setting> table{
      {"peak", d.peak_cd_m2, 1e-6, 1e6, "cd/m2", "luminance that becomes white"},
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

PqOptions options_of(const SettingValues& values, const RadianceScale& scale) {
  PqOptions o{number(settings(), values, "peak"), 1, number(settings(), values, "alpha")};
  o.cd_m2_per_unit =
      number_unless_automatic(settings(), values, "unit").value_or(scale.to_cd_m2(kLogAverage_cd_m2));
  o.validate();
  return o;
}

std::vector<FittedValue> report(const PqOptions& o) {
  return {{"cd_m2_per_unit", o.cd_m2_per_unit, "cd/m2"}, {"peak", o.peak_cd_m2, "cd/m2"}};
}

FittedOperator fit_pq(std::string_view, const SettingValues& values, const FitScope& scope) {
  const PqOptions o = options_of(values, scope.scale);
  return {
      [o](const OperatorView& view, int threads) { return apply(o, *view.colour, threads); }, report(o), {}};
}

}  // namespace

OperatorInfo pq_entry() {
  return {.id = "pq",
          .title = "Perceptual quantiser",
          .description = "the signal of SMPTE ST 2084 over that of a peak; nothing is fitted",
          .source = "SMPTE ST 2084; Zhao 2019, section 2.3",
          .input_unit = "cd/m2",
          .settings = settings(),
          .variants = {{"fixed", OperatorScope::kLightField, false, "every view alike"}},
          .fit = fit_pq,
          .map_frame = {}};
}

}  // namespace plenolab
