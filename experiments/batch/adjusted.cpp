#include "experiments/batch/adjusted.h"

#include <algorithm>
#include <optional>

#include "core/base/error.h"

namespace plenolab {

namespace {

/// For mapped views in memory; those that do not fit are mapped again when they are needed.
constexpr std::size_t kMemory_bytes = std::size_t{1} << 30;

}  // namespace

AdjustedField adjusted_field(const OperatorChoice& choice, const LoadedInput& input,
                             const std::vector<BatchView>& wanted, int threads) {
  const LightField* const field = input.light_field();
  if (!field) throw InputError("key-view adjustment is for light fields, not for single images");
  const auto fit = [&](const BatchView& place) {
    return choice.info->fit(choice.variant.id, choice.values,
                            input.scope(choice.variant.scope, place, threads));
  };
  std::optional<FittedOperator> joint;
  if (choice.variant.scope == OperatorScope::kLightField) joint = fit({});
  const auto map_view = [&](const BatchView& place) {
    return (joint ? *joint : fit(place)).apply(input.view(place), threads);
  };
  const DisplayLightField mapped(
      field->grid(), field->unit(), field->name(),
      [&](int column, int row) {
        return KeyView<DisplayReferred>{map_view({column, row}).image, field->view(column, row)->disparity};
      },
      kMemory_bytes);
  AdjustedField adjusted;
  const auto keep = [&](int column, int row, const DisplayImage& image) {
    const BatchView place{column, row};
    if (std::find(wanted.begin(), wanted.end(), place) != wanted.end())
      adjusted.views[place] = {image, map_view(place).counts};
  };
  adjusted.counts =
      adjust_key_views(*field, mapped, {}, keep, {.threads = threads, .memory_bound_bytes = kMemory_bytes});
  return adjusted;
}

}  // namespace plenolab
