#pragma once

#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/lightfield/light_field.h"
#include "core/tonemap/operator.h"

/// Operators of the table (operator.h) applied to the key views of a light field and to views synthesised
/// from it.
namespace plenolab {

/// Statistics of the key views, row by row (row·columns + column), and of all of them.
struct LightFieldStatistics {
  std::vector<ViewStatistics> views;
  ViewStatistics all;
  double floor = 1;     ///< log_floor(all)
  RadianceScale scale;  ///< of radiance in all views

  /// Of one view with the floor of the light field.
  ImageStatistics of_view(std::size_t index) const { return evaluate(views.at(index), floor); }
};

/// Loads every view once.
LightFieldStatistics measure_light_field(const LightField& field, int threads = 0,
                                         const Progress& progress = {});

/// What operators are fitted to: one view, or all.
FitScope scope_of_view(const LightField& field, const LightFieldStatistics& statistics, int column, int row,
                       int threads = 0);
FitScope scope_of_light_field(const LightField& field, const LightFieldStatistics& statistics,
                              int threads = 0);

/// A key view with its disparity, as operators take it; keeps the view loaded while held.
OperatorView operator_view(const LightField& field, int column, int row);

/// Receives the mapped key views, row by row, each once, with the fit that mapped it.
using MappedViewSink =
    std::function<void(int column, int row, const ToneMapped& mapped, const FittedOperator& fitted)>;

/// Maps every key view with a variant of scope kView (one fit a view) or kLightField (one fit). Returns the
/// sum of all counts. Throws InputError for variants of scope kFrame.
MappingCounts map_light_field(const OperatorInfo& info, std::string_view variant, const SettingValues& values,
                              const LightField& field, const LightFieldStatistics& statistics,
                              const MappedViewSink& sink, int threads = 0, const Progress& progress = {});

/// Fills in the scale of radiance, and the statistics and bilinear weights of the key views around a position
/// of the grid (those of select_key_views: one on a key view, up to four else). Throws InputError if it is
/// not on the grid.
void set_key_views(const LightFieldStatistics& statistics, const ViewGrid& grid, CameraPosition position,
                   FrameInput& frame);

}  // namespace plenolab
