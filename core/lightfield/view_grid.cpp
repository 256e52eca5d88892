#include "core/lightfield/view_grid.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.h"

namespace plenolab {

namespace {
double focal_length_px(const ViewGrid& grid) {
  return grid.width / (2.0 * std::tan(grid.fov_h_deg * std::numbers::pi / 360.0));
}
}  // namespace

void ViewGrid::validate() const {
  if (columns < 1 || rows < 1)
    throw InputError(
        fmt::format("a light field needs at least one column and row, not {} × {}", columns, rows));
  if (!(spacing_x_m > 0 && spacing_y_m > 0 && std::isfinite(spacing_x_m) && std::isfinite(spacing_y_m)))
    throw InputError(
        fmt::format("the view spacing must be positive metres, not {} × {}", spacing_x_m, spacing_y_m));
  if (width < 1 || height < 1)
    throw InputError(fmt::format("the views must have at least one pixel, not {} × {}", width, height));
  if (!(fov_h_deg > 0 && fov_h_deg < 180))
    throw InputError(
        fmt::format("the horizontal opening angle must lie in (0, 180) degrees, not {}", fov_h_deg));
}

double ViewGrid::disparity_px(double depth_m) const {
  return std::isinf(depth_m) ? 0.0 : focal_length_px(*this) * spacing_x_m / depth_m;
}

double ViewGrid::depth_m(double disparity_px) const {
  return disparity_px > 0 ? focal_length_px(*this) * spacing_x_m / disparity_px
                          : std::numeric_limits<double>::infinity();
}

bool ViewGrid::contains(CameraPosition position) const {
  return position.s >= 0 && position.t >= 0 && position.s <= columns - 1 && position.t <= rows - 1;
}

}  // namespace plenolab
