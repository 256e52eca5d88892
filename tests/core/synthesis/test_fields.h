#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/lightfield/light_field.h"

namespace plenolab::testing_support {

inline ViewGrid grid_of(int columns, int rows, int width, int height, double vertical_ratio = 1) {
  ViewGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.spacing_x_m = 0.1;
  grid.spacing_y_m = 0.1 * vertical_ratio;
  grid.width = width;
  grid.height = height;
  grid.fov_h_deg = 60;
  return grid;
}

/// A light field whose pixel (x, y) of key view (column, row) is `pixel(column, row, x, y)`: colour and
/// disparity.
using PixelFunction = std::function<std::pair<Rgb, float>(int column, int row, int x, int y)>;

inline LightField field_of(const ViewGrid& grid, const PixelFunction& pixel) {
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      KeyView<SceneReferred> view{SceneImage(grid.width, grid.height), DisparityMap(grid.width, grid.height)};
      for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x)
          std::tie(view.colour.at(x, y), view.disparity.at(x, y)) = pixel(column, row, x, y);
      views.push_back(std::move(view));
    }
  return LightField::from_views(grid, RadianceUnit::kRelative, "test field", std::move(views));
}

inline float noise(std::uint64_t seed, std::uint64_t index) {
  return unit_float(random_u64(seed, 77, index));
}

/// Index of a pixel of a view, for noise.
inline std::uint64_t pixel_index(int column, int row, int x, int y) {
  return static_cast<std::uint64_t>(((row * 64 + column) * 4096 + y)) * 4096 + static_cast<std::uint64_t>(x);
}

inline Rgb noise_colour(std::uint64_t seed, std::uint64_t index) {
  return {noise(seed, 3 * index), noise(seed, 3 * index + 1), noise(seed, 3 * index + 2)};
}

/// Unrelated noise in every view: colours in [0, 1), disparities in [0, `largest`).
inline LightField random_field(const ViewGrid& grid, float largest, std::uint64_t seed) {
  return field_of(grid, [&](int c, int r, int x, int y) {
    const std::uint64_t n = pixel_index(c, r, x, y);
    return std::pair(noise_colour(seed, n), largest * noise(seed + 1, n));
  });
}

/// Smooth slanted surface with steps, and `outliers` of the pixels with an unrelated disparity.
inline LightField stepped_field(const ViewGrid& grid, float largest, float outliers, std::uint64_t seed) {
  return field_of(grid, [&](int c, int r, int x, int y) {
    const std::uint64_t n = pixel_index(c, r, x, y);
    const float slant = static_cast<float>(x + 2 * y) / static_cast<float>(grid.width + 2 * grid.height);
    float disparity = largest * (0.2f + 0.3f * slant);
    if ((x / 7 + y / 5) % 3 == 0) disparity = largest * (0.6f + 0.4f * slant);
    if (noise(seed + 2, n) < outliers) disparity = largest * noise(seed + 3, n);
    return std::pair(noise_colour(seed, n), disparity);
  });
}

/// Discs before a slanted surface whose edges are ramps, from steep to gentle, facing every direction.
inline LightField ramped_field(const ViewGrid& grid, float largest, std::uint64_t seed) {
  return field_of(grid, [&](int c, int r, int x, int y) {
    const std::uint64_t n = pixel_index(c, r, x, y);
    float disparity = largest * (0.1f + 0.1f * static_cast<float>(x) / static_cast<float>(grid.width));
    for (std::uint64_t disc = 0; disc < 12; ++disc) {
      const auto random = [&](std::uint64_t k) { return noise(seed, 4 * disc + k); };
      const float dx = static_cast<float>(x) - random(0) * static_cast<float>(grid.width);
      const float dy = static_cast<float>(y) - random(1) * static_cast<float>(grid.height);
      const float inside = 4 + 12 * random(2) - std::hypot(dx, dy), width = 1 + 8 * random(3);
      const float share = std::min(inside / width, 1.0f);
      if (share > 0) disparity = std::max(disparity, largest * (0.3f + 0.7f * random(2)) * share);
    }
    return std::pair(noise_colour(seed, n), disparity);
  });
}

/// A smooth texture on the plane, in image coordinates of key view (0, 0) at disparity 0.
inline float texture(double x, double y) {
  return static_cast<float>(0.5 + 0.2 * std::sin(0.35 * x) + 0.2 * std::sin(0.27 * y + 0.1 * x));
}

/// What a view at (s, t) sees at (x, y) of a fronto-parallel textured plane: q = p + (F_p − F_q)·d.
inline Rgb plane_colour(const ViewGrid& grid, CameraPosition at, double x, double y, double disparity) {
  const float v = texture(x + at.s * disparity, y + at.t * disparity * grid.vertical_ratio());
  return {v, 0.5f * v, 0.25f + 0.5f * v};
}

inline LightField plane_field(const ViewGrid& grid, double disparity) {
  return field_of(grid, [&](int c, int r, int x, int y) {
    const CameraPosition at{static_cast<double>(c), static_cast<double>(r)};
    return std::pair(plane_colour(grid, at, x + 0.5, y + 0.5, disparity), static_cast<float>(disparity));
  });
}

}  // namespace plenolab::testing_support
