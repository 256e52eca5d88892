#include <algorithm>

#include "core/base/error.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/operators/entries.h"

namespace plenolab {

namespace {

SettingValue value_of(std::span<const Setting> settings, const SettingValues& values, std::string_view name) {
  const auto given = values.find(std::string(name));
  if (given != values.end()) return given->second;
  for (const Setting& s : settings)
    if (s.name == name) return {s.default_value, !s.automatic.empty()};
  PLENOLAB_CHECK(false, std::string(name));
  return {};
}

}  // namespace

double number(std::span<const Setting> settings, const SettingValues& values, std::string_view name) {
  const SettingValue value = value_of(settings, values, name);
  PLENOLAB_CHECK(!value.automatic, std::string(name));
  return value.number;
}

std::optional<double> number_unless_automatic(std::span<const Setting> settings, const SettingValues& values,
                                              std::string_view name) {
  const SettingValue value = value_of(settings, values, name);
  return value.automatic ? std::nullopt : std::optional<double>(value.number);
}

FittedOperator keep_black(FittedOperator fitted, const FitScope& scope) {
  if (scope.statistics.average_luminance > 0) return fitted;
  fitted.apply = [](const OperatorView& view, int threads) {
    return map_rows(*view.colour, threads,
                    [](int, std::span<const Rgb>, std::span<Rgb> out, RowBuffers&, MappingCounts&) {
                      std::fill(out.begin(), out.end(), Rgb{});
                    });
  };
  fitted.notes = {"no pixel is lit, so the image stays black"};
  return fitted;
}

Adapted<ImageStatistics> follow_statistics(const FrameInput& frame,
                                           const std::optional<FrameState>& previous) {
  const ImageStatistics target = blend(frame.key_views, frame.weights);
  return adapt(frame.adaptation, previous ? std::optional(previous->statistics) : std::nullopt, target,
               frame.step_s);
}

std::vector<OperatorVariant> statistics_variants() {
  return {{"naive", OperatorScope::kView, false, "statistics of each view"},
          {"joint", OperatorScope::kLightField, false, "statistics of all views"},
          {"interpolate-statistics", OperatorScope::kFrame, false,
           "frames, with statistics of key views blended and adapted in time"}};
}

Setting colour_exponent_setting(double default_value) {
  return {"alpha", default_value, 0, 1, "", "exponent of the colour ratio: 1 saturated, 0 grey"};
}

}  // namespace plenolab
