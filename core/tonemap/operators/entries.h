#pragma once

#include <optional>
#include <string_view>

#include "core/tonemap/bilateral.h"
#include "core/tonemap/operator.h"

/// Entries of the table of operators, one source file each, and what they share. To add an operator: a file
/// here that defines its entry, its declaration below, a line in operator_table.cpp.
namespace plenolab {

OperatorInfo bilateral_entry();
OperatorInfo generic_entry();
OperatorInfo content_adaptive_entry();
OperatorInfo histogram_entry();
OperatorInfo pq_entry();
OperatorInfo reinhard_devlin_entry();
OperatorInfo reinhard_global_entry();
OperatorInfo robust_adaptive_entry();

/// What a variant of the bilateral operator with these settings does, e.g. to look at its layers.
BilateralToneOptions bilateral_options(std::string_view variant, const SettingValues& values);

/// The number of a setting that cannot be automatic; its default if `values` lacks it.
double number(std::span<const Setting> settings, const SettingValues& values, std::string_view name);
/// The number of a setting, nothing if it is automatic.
std::optional<double> number_unless_automatic(std::span<const Setting> settings, const SettingValues& values,
                                              std::string_view name);

/// A fit to a scope without a lit pixel maps to black: there is no luminance that could be called bright.
FittedOperator keep_black(FittedOperator fitted, const FitScope& scope);

/// Statistics of a frame: those of the key views blended bilinearly, then adapted in time.
Adapted<ImageStatistics> follow_statistics(const FrameInput& frame,
                                           const std::optional<FrameState>& previous);

/// The setting of the exponent of the colour ratio.
Setting colour_exponent_setting(double default_value);

/// Variants of operators whose parameters follow from statistics of luminance and nothing else.
std::vector<OperatorVariant> statistics_variants();

/// Their OperatorInfo::fit and map_frame. `options_of` makes options from SettingValues; `report` lists
/// parameters as FittedValues; fit(options, statistics) and apply(parameters, image, threads) are the
/// operator's own.
template <auto options_of, auto report>
FittedOperator fit_to_statistics(std::string_view, const SettingValues& values, const FitScope& scope) {
  const auto p = fit(options_of(values), scope.statistics);
  return {
      [p](const OperatorView& view, int threads) { return apply(p, *view.colour, threads); }, report(p), {}};
}

template <auto options_of, auto report>
MappedFrame map_by_statistics(std::string_view, const SettingValues& values, const FrameInput& frame,
                              const std::optional<FrameState>& previous) {
  FrameState state;
  state.statistics = follow_statistics(frame, previous);
  const auto p = fit(options_of(values), state.statistics.value);
  return {apply(p, *frame.view, frame.threads), state, report(p)};
}

}  // namespace plenolab
