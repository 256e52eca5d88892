#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stimuli/tracer/maths.h"
#include "stimuli/tracer/preetham.h"

namespace plenolab::tracer {

/// A direction drawn towards light from outside.
struct DirectionSample {
  Vec3 direction;
  float pdf = 0;  ///< per solid angle
};

/// Light from infinitely far: the sky above the horizon (z > 0), the ground below. The gradient is linear in
/// the sine of the elevation. Directions are drawn from a table of luminance over latitude and longitude.
class SkyLight {
 public:
  explicit SkyLight(const Scene& scene);

  /// False if every direction is black.
  bool shines() const { return shines_; }
  Rgb radiance(const Vec3& direction) const;
  DirectionSample sample(std::array<float, 2> u) const;
  float pdf(const Vec3& direction) const;

 private:
  static constexpr int kRows = 128, kColumns = 256;
  double cell_weight(int row, int column) const;
  void build_table();

  Sky sky_;
  Vec3 sun_direction_{0, 0, 1};
  std::optional<PreethamSky> daylight_;
  bool shines_ = false;
  std::vector<float> row_cdf_;     ///< kRows + 1
  std::vector<float> column_cdf_;  ///< (kColumns + 1) a row
};

}  // namespace plenolab::tracer
