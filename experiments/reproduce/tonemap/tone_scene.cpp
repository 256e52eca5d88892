#include "experiments/reproduce/tonemap/tone_scene.h"

#include <fmt/format.h>

#include "experiments/reproduce/tonemap/mapping_bench.h"

namespace plenolab {

OperatorView ToneScene::view(std::size_t index) const {
  const int columns = field.grid().columns, i = static_cast<int>(index);
  return operator_view(field, i % columns, i / columns);
}

ToneScene tone_scene(Laboratory& laboratory, const std::string& id) {
  return {id, laboratory.scene(id).title, laboratory.light_field(id),
          laboratory.mapping_bench().statistics(id)};
}

std::size_t middle_view(const ViewGrid& grid) {
  return static_cast<std::size_t>(grid.rows / 2 * grid.columns + grid.columns / 2);
}

std::string view_name(const ViewGrid& grid, std::size_t index) {
  const int i = static_cast<int>(index);
  return fmt::format("{}, {}", i % grid.columns, i / grid.columns);
}

LogHistogram histogram_of_view(const ToneScene& scene, std::size_t index, int bins, int threads) {
  const ImageStatistics numbers = scene.statistics.of_view(index);
  return measure_histogram(*scene.view(index).colour, scene.statistics.floor, numbers.log_min,
                           numbers.log_max, bins, threads);
}

std::string name_of(HistogramCeiling ceiling) {
  switch (ceiling) {
    case HistogramCeiling::kPerceptual:
      return "perceptual";
    case HistogramCeiling::kLinear:
      return "linear";
    case HistogramCeiling::kAsPrinted:
      return "as printed";
    case HistogramCeiling::kLinearAsPrinted:
      return "linear as printed";
  }
  return "";
}

}  // namespace plenolab
