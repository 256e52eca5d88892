#include "core/luminance/multi_view_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

int pixel_at(double share, int pixels) {
  return std::clamp(static_cast<int>(share * pixels), 0, pixels - 1);
}

}  // namespace

void MultiViewDisplayOptions::validate() const {
  space.validate();
  if (space.on_a_plane()) throw InputError("the views of a multi-view display lie on a line, not on a plane");
  if (views < 1 || views > 10'000)
    throw InputError(fmt::format("a multi-view display must have 1 to 10000 views, not {}", views));
  if (width < 1 || height < 1 || width > 16'384 || height > 16'384)
    throw InputError(
        fmt::format("images of a display must have 1 to 16384 pixels each way, not {} × {}", width, height));
  if (interleaved && width < views)
    throw InputError(fmt::format("{} views cannot take turns in rows of {} pixels", views, width));
}

MultiViewDisplay::MultiViewDisplay(const MultiViewDisplayOptions& options) : options_(options) {
  options_.validate();
  const DisplaySpace& space = options_.space;
  cells_ = {options_.views, 1, space.x_min_m, space.x_max_m, 0, 0};
}

PinholeSize MultiViewDisplay::resolution() const {
  return {options_.interleaved ? options_.width / options_.views : options_.width, options_.height};
}

RayCount MultiViewDisplay::size() const {
  return {options_.interleaved ? 1 : options_.views, options_.width, options_.height};
}

int MultiViewDisplay::view_of(const Ray& ray) const {
  if (!options_.interleaved) return ray.image;
  const long long turn = ray.u + static_cast<long long>(ray.v) * options_.shift_px_per_row;
  return static_cast<int>((turn % options_.views + options_.views) % options_.views);
}

ScreenPoint MultiViewDisplay::screen_point(const Ray& ray) const {
  return {(ray.u + 0.5) / options_.width, (ray.v + 0.5) / options_.height};
}

ObserverPosition MultiViewDisplay::position(const Ray& ray) const {
  return cells_.position(view_of(ray));
}

double MultiViewDisplay::weight(const Ray& ray, ObserverPosition observer) const {
  return cells_.nearest(observer) == view_of(ray) ? 1 : 0;
}

double MultiViewDisplay::reach_m() const {
  return cells_.step_x_m();
}

int MultiViewDisplay::nearest_pixel_of(int view, double across, int v) const {
  const int start = pixel_at(across, options_.width);
  int best = -1;
  double nearest = 0;
  for (int u = std::max(0, start - options_.views); u <= std::min(options_.width - 1, start + options_.views);
       ++u) {
    const double distance = std::abs(u + 0.5 - across * options_.width);
    if (view_of({0, u, v}) == view && (best < 0 || distance < nearest)) best = u, nearest = distance;
  }
  return best;
}

void MultiViewDisplay::rays_at(ScreenPoint point, std::vector<Ray>& rays) const {
  const int v = pixel_at(point.down, options_.height);
  for (int view = 0; view < options_.views; ++view)
    rays.push_back(options_.interleaved ? Ray{0, nearest_pixel_of(view, point.across, v), v}
                                        : Ray{view, pixel_at(point.across, options_.width), v});
}

}  // namespace plenolab
