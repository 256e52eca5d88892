#include "core/luminance/lens_array_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/luminance/projector_display.h"

namespace plenolab {

namespace {

double fraction(double value) {
  return value - std::floor(value);
}

/// Position of the share f below a lens, turned around.
double turned(double f, double low, double high) {
  return low + (1 - f) * (high - low);
}

}  // namespace

void LensArrayDisplayOptions::validate() const {
  space.validate();
  const bool plane = kind == Kind::kFullParallax;
  if (plane != space.on_a_plane())
    throw InputError(
        plane ? "observers of a display with full parallax stand on a plane: give them a range of heights"
              : "observers of a display with horizontal parallax stand on a line, not on a plane");
  if (width < 1 || height < 1 || width > 65'536 || height > 65'536)
    throw InputError(fmt::format("a panel must have 1 to 65536 pixels each way, not {} × {}", width, height));
  if (lenses_across < 1 || lenses_across > width || (plane && (lenses_down < 1 || lenses_down > height)))
    throw InputError(
        fmt::format("a panel of {} × {} pixels can have at most as many lenses each way, not {} × {}", width,
                    height, lenses_across, lenses_down));
  if (!(std::abs(slant_lenses) <= 1e4) || (plane && slant_lenses != 0))
    throw InputError(fmt::format("lenses of {} cannot be slanted by {:g} lenses",
                                 plane ? "a display with full parallax" : "this display", slant_lenses));
}

LensArrayDisplay::LensArrayDisplay(const LensArrayDisplayOptions& options) : options_(options) {
  options_.validate();
  const DisplaySpace& space = options_.space;
  spread_x_m_ = (space.x_max_m - space.x_min_m) * options_.lenses_across / options_.width;
  spread_y_m_ = (space.y_max_m - space.y_min_m) * options_.lenses_down / options_.height;
}

double LensArrayDisplay::phase(double across, double down) const {
  return across * options_.lenses_across - options_.slant_lenses * down;
}

double LensArrayDisplay::profile(double t) const {
  if (options_.kind == LensArrayDisplayOptions::Kind::kParallaxBarrier) return std::abs(t) <= 0.5 ? 1 : 0;
  return diffuser_profile(t);
}

ScreenPoint LensArrayDisplay::screen_point(const Ray& ray) const {
  const double across = (ray.u + 0.5) / options_.width, down = (ray.v + 0.5) / options_.height;
  const double middle = std::floor(phase(across, down)) + 0.5;
  const double x = (middle + options_.slant_lenses * down) / options_.lenses_across;
  const double y =
      full_parallax() ? (std::floor(down * options_.lenses_down) + 0.5) / options_.lenses_down : down;
  return {std::clamp(x, 0.0, 1.0), y};
}

ObserverPosition LensArrayDisplay::position(const Ray& ray) const {
  const double across = (ray.u + 0.5) / options_.width, down = (ray.v + 0.5) / options_.height;
  const DisplaySpace& space = options_.space;
  const double x = turned(fraction(phase(across, down)), space.x_min_m, space.x_max_m);
  if (!full_parallax()) return {x, 0};
  // Rows run downwards, heights upwards: below its lens, a pixel farther down is seen from farther up.
  return {x, turned(1 - fraction(down * options_.lenses_down), space.y_min_m, space.y_max_m)};
}

double LensArrayDisplay::weight(const Ray& ray, ObserverPosition observer) const {
  const ObserverPosition best = position(ray);
  const double across = profile((observer.x_m - best.x_m) / spread_x_m_);
  return full_parallax() ? across * profile((observer.y_m - best.y_m) / spread_y_m_) : across;
}

double LensArrayDisplay::reach_m() const {
  return 1.5 * std::max(spread_x_m_, spread_y_m_);
}

void LensArrayDisplay::rays_at(ScreenPoint point, std::vector<Ray>& rays) const {
  const int row = std::clamp(static_cast<int>(point.down * options_.height), 0, options_.height - 1);
  const double row_down = (row + 0.5) / options_.height;
  const double lens = std::floor(phase(point.across, row_down));
  const int lens_row =
      std::min(static_cast<int>(point.down * options_.lenses_down), options_.lenses_down - 1);
  const auto column = [&](double edge) {
    return static_cast<int>(
        std::floor((edge + options_.slant_lenses * row_down) / options_.lenses_across * options_.width));
  };
  const int first_row = full_parallax() ? lens_row * options_.height / options_.lenses_down : row;
  const int last_row = full_parallax() ? ((lens_row + 1) * options_.height - 1) / options_.lenses_down : row;
  for (int v = first_row; v <= std::min(last_row, options_.height - 1); ++v)
    for (int u = std::max(0, column(lens) - 1); u <= std::min(options_.width - 1, column(lens + 1) + 1);
         ++u) {
      const double down = (v + 0.5) / options_.height;
      const bool below =
          std::floor(phase((u + 0.5) / options_.width, full_parallax() ? 0.0 : down)) == lens &&
          (!full_parallax() || static_cast<int>(down * options_.lenses_down) == lens_row);
      if (below) rays.push_back({0, u, v});
    }
}

}  // namespace plenolab
