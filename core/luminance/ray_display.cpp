#include "core/luminance/ray_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr int kMostSamples = 10'000'000;

/// Number of the cell of [low, high] that holds a value, the upper one at borders; the last cell is closed,
/// as an observer at the end of the range sees the display, too. −1 outside.
int cell_of(double value, double low, double high, int cells) {
  if (!(value >= low && value <= high)) return -1;
  return std::min(cells - 1, static_cast<int>((value - low) / (high - low) * cells));
}

}  // namespace

void PinholeSize::validate() const {
  if (width < 1 || height < 1 || width > 16'384 || height > 16'384)
    throw InputError(
        fmt::format("a pinhole image must have 1 to 16384 pixels each way, not {} × {}", width, height));
}

void DisplaySpace::validate() const {
  const auto require_length = [](double value, const char* name) {
    if (!(value > 0 && value <= 1e6))
      throw InputError(
          fmt::format("the {} of a display must be above 0 and at most 1e6 m, not {:g}", name, value));
  };
  require_length(width_m, "width");
  require_length(height_m, "height");
  require_length(observer_distance_m, "distance to its observers");
  for (const double end : {x_min_m, x_max_m, y_min_m, y_max_m})
    if (!(std::abs(end) <= 1e6))
      throw InputError(
          fmt::format("observers must stand within 1e6 m of the display's axis, not at {:g}", end));
  if (x_max_m <= x_min_m || y_max_m < y_min_m)
    throw InputError(fmt::format("observers must stand between two places, not from {:g} to {:g} m",
                                 x_max_m <= x_min_m ? x_min_m : y_min_m,
                                 x_max_m <= x_min_m ? x_max_m : y_max_m));
}

void ObserverSamples::validate() const {
  if (columns < 1 || rows < 1 || static_cast<long long>(columns) * rows > kMostSamples)
    throw InputError(
        fmt::format("there must be 1 to {} observer samples, not {} × {}", kMostSamples, columns, rows));
  if (!(x_max_m > x_min_m) || !(y_max_m >= y_min_m) || !std::isfinite(x_max_m - x_min_m) ||
      !std::isfinite(y_max_m - y_min_m))
    throw InputError(fmt::format("observer samples need a range, not {:g} to {:g} m by {:g} to {:g} m",
                                 x_min_m, x_max_m, y_min_m, y_max_m));
  if (rows > 1 && y_max_m == y_min_m)
    throw InputError(fmt::format("observers on a line have one row of samples, not {}", rows));
}

ObserverPosition ObserverSamples::position(int sample) const {
  const int column = sample % columns, row = sample / columns;
  return {x_min_m + (column + 0.5) * step_x_m(), y_min_m + (row + 0.5) * step_y_m()};
}

int ObserverSamples::nearest(ObserverPosition position) const {
  const int column = cell_of(position.x_m, x_min_m, x_max_m, columns);
  const int row = rows == 1 ? 0 : cell_of(position.y_m, y_min_m, y_max_m, rows);
  return column < 0 || row < 0 ? -1 : row * columns + column;
}

ObserverSamples samples_of(const RayDisplay& display, int columns, int rows) {
  const DisplaySpace& space = display.space();
  const int used_rows = !space.on_a_plane() ? 1 : rows > 0 ? rows : columns;
  ObserverSamples samples{columns, used_rows, space.x_min_m, space.x_max_m, space.y_min_m, space.y_max_m};
  samples.validate();
  return samples;
}

}  // namespace plenolab
