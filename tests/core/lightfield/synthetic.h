#pragma once

#include <cmath>
#include <functional>

#include "core/base/random.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// Smooth random texture over the plane: value noise of a few octaves in [0, 1], no symmetry, no period.
inline float noise_texture(double x, double y, std::uint64_t purpose) {
  const auto lattice = [purpose](std::int64_t i, std::int64_t j) {
    return unit_double(random_u64(static_cast<std::uint64_t>(i), purpose, static_cast<std::uint64_t>(j)));
  };
  double sum = 0, weight = 0;
  for (const double period : {19.0, 7.0, 3.7}) {
    const double u = x / period, v = y / period;
    const auto i = static_cast<std::int64_t>(std::floor(u)), j = static_cast<std::int64_t>(std::floor(v));
    const double fu = u - std::floor(u), fv = v - std::floor(v);
    const double su = fu * fu * (3 - 2 * fu), sv = fv * fv * (3 - 2 * fv);
    sum += period * ((lattice(i, j) * (1 - su) + lattice(i + 1, j) * su) * (1 - sv) +
                     (lattice(i, j + 1) * (1 - su) + lattice(i + 1, j + 1) * su) * sv);
    weight += period;
  }
  return static_cast<float>(sum / weight);
}

/// Two fronto-parallel textured planes: a square of disparity `near_px` before a background of disparity
/// `far_px`, seen from view (column, row): what is at p in view (0, 0) is at p − (column, ratio·row)·d.
struct TwoPlanes {
  ViewGrid grid{.columns = 3,
                .rows = 3,
                .spacing_x_m = 0.1,
                .spacing_y_m = 0.1,
                .width = 96,
                .height = 72,
                .fov_h_deg = 50};
  double near_px = 4, far_px = 1;
  float radiance = 100;  ///< brightest

  bool is_near(double x, double y) const { return x > 35 && x < 70 && y > 25 && y < 55; }

  template <class Referral>
  KeyView<Referral> view(double column, double row) const {
    KeyView<Referral> v;
    v.colour = RgbImage<Referral>(grid.width, grid.height);
    v.disparity = DisparityMap(grid.width, grid.height);
    for (int y = 0; y < grid.height; ++y)
      for (int x = 0; x < grid.width; ++x) {
        const double r = grid.vertical_ratio() * row;
        const double nx = x + 0.5 + column * near_px, ny = y + 0.5 + r * near_px;
        const bool near = is_near(nx, ny);
        const double d = near ? near_px : far_px;
        const float value = noise_texture(x + 0.5 + column * d, y + 0.5 + r * d, near ? 1 : 2);
        v.colour.at(x, y) = Rgb{value, value * 0.8f, value * value} * radiance;
        v.disparity.at(x, y) = static_cast<float>(d);
      }
    return v;
  }

  template <class Referral = SceneReferred>
  std::vector<KeyView<Referral>> views() const {
    std::vector<KeyView<Referral>> all;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) all.push_back(view<Referral>(column, row));
    return all;
  }

  template <class Referral = SceneReferred>
  BasicLightField<Referral> light_field() const {
    return BasicLightField<Referral>::from_views(grid, RadianceUnit::kCdM2, "two planes", views<Referral>());
  }
};

}  // namespace plenolab
