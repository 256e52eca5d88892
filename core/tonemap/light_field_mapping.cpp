#include "core/tonemap/light_field_mapping.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/synthesis/key_views.h"

namespace plenolab {

namespace {

std::size_t index_of(const ViewGrid& grid, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
         static_cast<std::size_t>(column);
}

/// Calls visit(column, row) for every view of the grid, row by row.
template <class Visit>
void for_each_view(const ViewGrid& grid, const Progress& progress, const Visit& visit) {
  const double count = static_cast<double>(grid.columns) * grid.rows;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      visit(column, row);
      if (progress) progress(static_cast<double>(index_of(grid, column, row) + 1) / count);
    }
}

}  // namespace

LightFieldStatistics measure_light_field(const LightField& field, int threads, const Progress& progress) {
  LightFieldStatistics statistics;
  for_each_view(field.grid(), progress, [&](int column, int row) {
    statistics.views.push_back(measure_view(field.view(column, row)->colour, threads));
  });
  statistics.all = merge(statistics.views);
  statistics.floor = log_floor(statistics.all);
  if (field.unit() == RadianceUnit::kRelative)
    statistics.scale = {std::nullopt, evaluate(statistics.all, statistics.floor).log_robust_average};
  return statistics;
}

OperatorView operator_view(const LightField& field, int column, int row) {
  const auto view = field.view(column, row);
  return {{view, &view->colour}, {view, &view->disparity}};
}

FitScope scope_of_view(const LightField& field, const LightFieldStatistics& statistics, int column, int row,
                       int threads) {
  return {.views = 1,
          .load = [field, column, row](int) { return operator_view(field, column, row); },
          .statistics = statistics.of_view(index_of(field.grid(), column, row)),
          .floor = statistics.floor,
          .threads = threads,
          .scale = statistics.scale};
}

FitScope scope_of_light_field(const LightField& field, const LightFieldStatistics& statistics, int threads) {
  const int columns = field.grid().columns;
  return {.views = columns * field.grid().rows,
          .load = [field, columns](int i) { return operator_view(field, i % columns, i / columns); },
          .statistics = evaluate(statistics.all, statistics.floor),
          .floor = statistics.floor,
          .threads = threads,
          .scale = statistics.scale};
}

MappingCounts map_light_field(const OperatorInfo& info, std::string_view variant, const SettingValues& values,
                              const LightField& field, const LightFieldStatistics& statistics,
                              const MappedViewSink& sink, int threads, const Progress& progress) {
  const OperatorScope scope = find_variant(info, variant).scope;
  if (scope == OperatorScope::kFrame)
    throw InputError(fmt::format("variant {} of operator {} maps frames of a video; key views need another",
                                 variant, info.id));
  FittedOperator fitted;
  if (scope == OperatorScope::kLightField)
    fitted = info.fit(variant, values, scope_of_light_field(field, statistics, threads));
  MappingCounts counts;
  for_each_view(field.grid(), progress, [&](int column, int row) {
    if (scope == OperatorScope::kView)
      fitted = info.fit(variant, values, scope_of_view(field, statistics, column, row, threads));
    const ToneMapped mapped = fitted.apply(operator_view(field, column, row), threads);
    counts += mapped.counts;
    sink(column, row, mapped, fitted);
  });
  return counts;
}

void set_key_views(const LightFieldStatistics& statistics, const ViewGrid& grid, CameraPosition position,
                   FrameInput& frame) {
  frame.key_views.clear();
  frame.weights.clear();
  frame.scale = statistics.scale;
  for (const UsedView& view : select_key_views(grid, position)) {
    frame.key_views.push_back(statistics.of_view(index_of(grid, view.column, view.row)));
    frame.weights.push_back(view.weight);
  }
}

}  // namespace plenolab
