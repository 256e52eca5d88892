#include "experiments/reproduce/tonemap/central_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"

namespace plenolab {

namespace {

/// Opening angle of a part of the image.
double part_of_angle_deg(double fov_deg, double share) {
  constexpr double kHalfDegree = std::numbers::pi / 360;
  return std::atan(std::tan(fov_deg * kHalfDegree) * share) / kHalfDegree;
}

template <class Image>
Image middle_of(const Image& image, int width, int height) {
  Image part(width, height);
  const int left = (image.width() - width) / 2, top = (image.height() - height) / 2;
  for (int y = 0; y < height; ++y) std::copy_n(image.row(top + y) + left, width, part.row(y));
  return part;
}

/// The size, or one more, that leaves equal margins, so that the principal point stays in the middle.
int part_of_length(int length, int divisor) {
  const int part = std::max(1, length / divisor);
  return (length - part) % 2 == 0 ? part : part + 1;
}

}  // namespace

LightField central_part(const LightField& field, int divisor) {
  PLENOLAB_CHECK(divisor >= 1, "a part is not larger than the whole");
  ViewGrid grid = field.grid();
  const int width = part_of_length(grid.width, divisor), height = part_of_length(grid.height, divisor);
  grid.fov_h_deg = part_of_angle_deg(grid.fov_h_deg, static_cast<double>(width) / grid.width);
  grid.width = width;
  grid.height = height;
  return LightField(grid, field.unit(), field.name(), [field, width, height](int column, int row) {
    const auto view = field.view(column, row);
    return KeyView<SceneReferred>{middle_of(view->colour, width, height),
                                  middle_of(view->disparity, width, height)};
  });
}

}  // namespace plenolab
