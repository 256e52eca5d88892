#include "core/synthesis/key_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {
namespace {

double baseline_m(const ViewGrid& grid, const UsedView& view) {
  return std::hypot(view.b_x * grid.spacing_x_m, view.b_y * grid.spacing_y_m);
}

int cell_start(double coordinate, int count) {
  return std::max(0, std::min(static_cast<int>(std::floor(coordinate)), count - 2));
}

}  // namespace

std::vector<UsedView> select_key_views(const ViewGrid& grid, CameraPosition position, int count) {
  if (!grid.contains(position))
    throw InputError(
        fmt::format("the camera position ({}, {}) is outside the grid of {} × {} key views: s must be "
                    "in [0, {}] and t in [0, {}]",
                    position.s, position.t, grid.columns, grid.rows, grid.columns - 1, grid.rows - 1));
  const int column0 = cell_start(position.s, grid.columns), row0 = cell_start(position.t, grid.rows);
  std::vector<UsedView> views;
  for (int row = row0; row < std::min(row0 + 2, grid.rows); ++row)
    for (int column = column0; column < std::min(column0 + 2, grid.columns); ++column) {
      const double b_x = position.s - column, b_y = position.t - row;
      const double weight = (1 - std::abs(b_x)) * (1 - std::abs(b_y));
      const UsedView view{column, row, b_x, b_y, weight};
      if (b_x == 0 && b_y == 0) return {view};
      views.push_back(view);
    }
  std::stable_sort(views.begin(), views.end(), [&](const UsedView& a, const UsedView& b) {
    return baseline_m(grid, a) < baseline_m(grid, b);
  });
  views.resize(std::min(views.size(), static_cast<std::size_t>(count)));
  return views;
}

}  // namespace plenolab
