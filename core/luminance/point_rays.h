#pragma once

#include <span>
#include <vector>

#include "core/luminance/ray_display.h"

namespace plenolab {

/// The columns of a display's images that light the columns of a pinhole image, for displays in_columns():
/// what would otherwise be asked of the display for every pixel. In the order of X, so that those that reach
/// an observer are neighbours.
class PointColumns {
 public:
  struct Column {
    int image = 0, u = 0;
    double x_m = 0;
  };

  PointColumns(const RayDisplay& display, int pinhole_width);

  int width() const { return static_cast<int>(columns_.size()); }
  /// Columns whose light reaches an observer from pinhole column a, each with its weight > 0, those of the
  /// display as they are. Clears `columns` and `weights`, which must be of one thread.
  void reaching(int a, ObserverPosition observer, std::vector<Column>& columns,
                std::vector<float>& weights) const;

 private:
  const RayDisplay& display_;
  double reach_m_ = 0;
  std::vector<std::vector<Column>> columns_;
};

/// Divides weights by their sum; false, and as they are, if that is 0.
bool normalise(std::span<float> weights);
bool normalise(std::span<double> weights);

/// Rows of a display's images that rows of a pinhole image show: floor((b + ½)/rows·height).
std::vector<int> rows_shown(int rows, int height);

}  // namespace plenolab
