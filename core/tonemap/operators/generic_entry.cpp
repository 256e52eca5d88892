#include "core/tonemap/generic.h"
#include "core/tonemap/operators/entries.h"

namespace plenolab {

namespace {

const std::vector<Setting>& settings() {
  static const GenericOptions d;
  static const std::vector<Setting> table{
      {"b", d.brightness, -2, 2, "log10 units", "luminance over the log average that becomes luma 0.5"},
      {"d_l", d.low_range, 0.001, 2.5, "log10 units", "range shown below that"},
      {"d_h", d.high_range, 0.001, 2.5, "log10 units", "range shown above that"},
      {"c", d.contrast, 0.2, 1.5, "", "contrast: twice the slope there, in luma per log10 unit"},
      {"m1", d.fine, -2, 2, "octaves of gain", "of detail around 1/4 cycle a pixel and finer"},
      {"m2", d.middle, -2, 2, "octaves of gain", "of detail around 1/16 cycle a pixel"},
      {"m3", d.coarse, -2, 2, "octaves of gain", "of detail around 1/64 cycle a pixel"},
      colour_exponent_setting(d.colour_exponent),
      {"scale", d.band_scale, 1, 64, "", "the bands are those of the image averaged down by this"},
  };
  return table;
}

GenericOptions options_of(const SettingValues& values) {
  const auto value = [&](const char* name) { return number(settings(), values, name); };
  return {value("b"),  value("d_l"), value("d_h"),   value("c"),    value("m1"),
          value("m2"), value("m3"),  value("alpha"), value("scale")};
}

std::vector<FittedValue> report(const GenericParameters& p) {
  return {{"log_average", p.log_average, "log10 units"}};
}

}  // namespace

OperatorInfo generic_entry() {
  return {.id = "generic",
          .title = "Generic (Mantiuk & Seidel 2008)",
          .description = "sigmoid over log luminance with gains of three bands; what `optimise` tunes",
          .source = "Mantiuk & Seidel 2008, equations 2 and 4; Zhao 2019, section 2.8",
          .input_unit = "any",
          .settings = settings(),
          .variants = statistics_variants(),
          .fit = fit_to_statistics<options_of, report>,
          .map_frame = map_by_statistics<options_of, report>};
}

}  // namespace plenolab
