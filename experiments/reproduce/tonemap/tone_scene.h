#pragma once

#include <string>

#include "core/tonemap/histogram_adjustment.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/reproduce/laboratory.h"

namespace plenolab {

/// The key views of a scene with what operators are fitted to.
struct ToneScene {
  std::string id, title;
  LightField field;
  LightFieldStatistics statistics;

  std::size_t views() const { return statistics.views.size(); }
  /// View number row·columns + column.
  OperatorView view(std::size_t index) const;
};

ToneScene tone_scene(Laboratory& laboratory, const std::string& id);

/// Number of the key view in the middle of the grid.
std::size_t middle_view(const ViewGrid& grid);
/// "2, 1" for people: column and row.
std::string view_name(const ViewGrid& grid, std::size_t index);

/// Histogram of one key view between its own extremes, as histogram adjustment takes it.
LogHistogram histogram_of_view(const ToneScene& scene, std::size_t index, int bins, int threads);

/// "perceptual", "linear", "as printed" or "linear as printed".
std::string name_of(HistogramCeiling ceiling);

}  // namespace plenolab
