#include "core/luminance/projector_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr double kCut = 1.5;  // in widths at half maximum

void require_between(int value, int most, const char* what) {
  if (value < 1 || value > most)
    throw InputError(fmt::format("a projector display must have 1 to {} {}, not {}", most, what, value));
}

std::vector<double> places(const ProjectorDisplayOptions& options) {
  const double half = options.half_line_m(), distance = options.projector_distance_m;
  const double half_angle = std::atan2(half, distance);
  std::vector<double> x;
  for (int k = 0; k < options.projectors; ++k) {
    const double t = options.projectors == 1 ? 0 : 2.0 * k / (options.projectors - 1) - 1;
    x.push_back(options.layout == ProjectorDisplayOptions::Layout::kArc ? distance * std::tan(t * half_angle)
                                                                        : half * t);
  }
  return x;
}

/// Mean distance to the neighbours on both sides, times Z/D.
std::vector<double> spreads(const ProjectorDisplayOptions& options, const std::vector<double>& places) {
  const double scale = options.space.observer_distance_m / options.projector_distance_m;
  if (places.size() == 1) return {2 * options.half_line_m() * scale};
  std::vector<double> spread;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, places.size() - 1);
    spread.push_back((places[after] - places[before]) / static_cast<double>(after - before) * scale);
  }
  return spread;
}

int pixel_at(double share, int pixels) {
  return std::clamp(static_cast<int>(share * pixels), 0, pixels - 1);
}

}  // namespace

void ProjectorDisplayOptions::validate() const {
  space.validate();
  if (space.on_a_plane())
    throw InputError("observers of a display with horizontal parallax stand on a line, not on a plane");
  require_between(projectors, 10'000, "projectors");
  require_between(width, 16'384, "pixels across");
  require_between(height, 16'384, "pixels down");
  if (!(projector_distance_m > 0 && projector_distance_m <= 1e6))
    throw InputError(
        fmt::format("projectors must stand up to 1e6 m behind the screen, not {:g} m", projector_distance_m));
}

double ProjectorDisplayOptions::half_line_m() const {
  const double ratio = projector_distance_m / space.observer_distance_m;
  return space.width_m / 2 * (1 + ratio) + std::max(std::abs(space.x_min_m), std::abs(space.x_max_m)) * ratio;
}

ProjectorDisplayOptions projector_display_options(DisplayPreset preset) {
  switch (preset) {
    case DisplayPreset::kQuick:
      return {.projectors = 24, .width = 160, .height = 90};
    case DisplayPreset::kSmall:
      return {.width = 160, .height = 90};
    case DisplayPreset::kFull:
      return {};
    case DisplayPreset::kPaper:
      return {.width = 1280, .height = 720};
  }
  return {};
}

double diffuser_profile(double t) {
  constexpr double kFourLn2 = 2.772588722239781;
  return std::abs(t) <= kCut ? std::exp(-kFourLn2 * t * t) : 0;
}

ProjectorDisplay::ProjectorDisplay(const ProjectorDisplayOptions& options) : options_(options) {
  options_.validate();
  projector_x_m_ = places(options_);
  spread_m_ = spreads(options_, projector_x_m_);
  reach_m_ = kCut * *std::max_element(spread_m_.begin(), spread_m_.end());
}

RayCount ProjectorDisplay::size() const {
  return {options_.projectors, options_.width, options_.height};
}

ScreenPoint ProjectorDisplay::screen_point(const Ray& ray) const {
  return {(ray.u + 0.5) / options_.width, (ray.v + 0.5) / options_.height};
}

ObserverPosition ProjectorDisplay::position(const Ray& ray) const {
  const double s = (screen_point(ray).across - 0.5) * options_.space.width_m;
  return {
      s + (s - projector_x_m(ray.image)) * options_.space.observer_distance_m / options_.projector_distance_m,
      0};
}

double ProjectorDisplay::weight(const Ray& ray, ObserverPosition observer) const {
  return diffuser_profile((observer.x_m - position(ray).x_m) / spread_m(ray.image));
}

void ProjectorDisplay::rays_at(ScreenPoint point, std::vector<Ray>& rays) const {
  const int u = pixel_at(point.across, options_.width), v = pixel_at(point.down, options_.height);
  for (int k = 0; k < options_.projectors; ++k) rays.push_back({k, u, v});
}

}  // namespace plenolab
