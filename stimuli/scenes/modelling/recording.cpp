#include "stimuli/scenes/modelling/recording.h"

#include <cmath>
#include <numbers>

namespace plenolab {

GridCamera camera_along_y(const Vec3& centre_m, float fov_h_deg, float pitch_deg) {
  const float pitch = pitch_deg * std::numbers::pi_v<float> / 180;
  return {.centre_m = centre_m,
          .forward = {0, std::cos(pitch), std::sin(pitch)},
          .up = {0, -std::sin(pitch), std::cos(pitch)},
          .fov_h_deg = fov_h_deg};
}

GridPreset quick_views(double spacing_x_m, double spacing_y_m, int paths_per_pixel) {
  return {.columns = 5,
          .rows = 3,
          .spacing_x_m = spacing_x_m,
          .spacing_y_m = spacing_y_m,
          .width = 384,
          .height = 216,
          .paths_per_pixel = paths_per_pixel};
}

GridPreset paper_views(double spacing_m, int rows, int paths_per_pixel) {
  return {.columns = 17,
          .rows = rows,
          .spacing_x_m = spacing_m,
          .spacing_y_m = spacing_m,
          .width = 960,
          .height = 540,
          .paths_per_pixel = paths_per_pixel};
}

}  // namespace plenolab
