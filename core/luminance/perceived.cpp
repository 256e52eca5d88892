#include "core/luminance/perceived.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/luminance/point_rays.h"

namespace plenolab {

namespace {

void require_rays_of(const RayDisplay& display, const RayCount& size) {
  if (!(size == display.size()))
    throw InputError(fmt::format("the display has {} images of {} × {} pixels, but was given {} of {} × {}",
                                 display.size().images, display.size().width, display.size().height,
                                 size.images, size.width, size.height));
}

struct Sum {
  double r = 0, g = 0, b = 0;
  void add(Rgb c, double weight) {
    r += weight * static_cast<double>(c.r);
    g += weight * static_cast<double>(c.g);
    b += weight * static_cast<double>(c.b);
  }
  Rgb colour() const { return {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)}; }
};

/// One pixel; false if no ray lights it.
bool perceive_pixel(const RayDisplay& display, const RayValues<Rgb>& rays, ObserverPosition observer,
                    ScreenPoint point, std::vector<Ray>& at_point, Rgb& pixel) {
  at_point.clear();
  display.rays_at(point, at_point);
  Sum sum;
  double weights = 0;
  for (const Ray& ray : at_point) {
    const double weight = display.weight(ray, observer);
    if (!(weight > 0)) continue;
    sum.add(rays.at(ray), weight);
    weights += weight;
  }
  if (!(weights > 0)) return false;
  pixel = Sum{sum.r / weights, sum.g / weights, sum.b / weights}.colour();
  return true;
}

template <class Referral>
Perceived<Referral> perceive_pixels(const RayDisplay& display, const RayValues<Rgb>& rays,
                                    ObserverPosition observer, PinholeSize size, int threads) {
  Perceived<Referral> seen{RgbImage<Referral>(size.width, size.height), 0};
  std::atomic<std::int64_t> unlit = 0;
  parallel_for(size.height, 4, threads, [&](int begin, int end) {
    std::vector<Ray> at_point;
    for (int b = begin; b < end; ++b)
      for (int a = 0; a < size.width; ++a)
        if (!perceive_pixel(display, rays, observer, size.middle(a, b), at_point, seen.image.at(a, b)))
          ++unlit;
  });
  seen.unlit = unlit;
  return seen;
}

/// Adds a column of rays to a column of the picture.
void add_column(const Rgb* from, float weight, const std::vector<int>& rows, std::vector<Rgb>& to) {
  for (std::size_t b = 0; b < to.size(); ++b) to[b] += from[rows[b]] * weight;
}

template <class Referral>
Perceived<Referral> perceive_columns(const RayDisplay& display, const RayValues<Rgb>& rays,
                                     ObserverPosition observer, PinholeSize size, int threads) {
  Perceived<Referral> seen{RgbImage<Referral>(size.width, size.height), 0};
  const PointColumns points(display, size.width);
  const std::vector<int> rows = rows_shown(size.height, rays.size().height);
  std::atomic<std::int64_t> unlit = 0;
  parallel_for(size.width, 32, threads, [&](int begin, int end) {
    std::vector<PointColumns::Column> columns;
    std::vector<float> weights;
    std::vector<Rgb> picture(rows.size());
    for (int a = begin; a < end; ++a) {
      points.reaching(a, observer, columns, weights);
      if (!normalise(std::span(weights))) {
        unlit += size.height;
        continue;
      }
      std::fill(picture.begin(), picture.end(), Rgb{});
      for (std::size_t i = 0; i < columns.size(); ++i)
        add_column(rays.column(columns[i].image, columns[i].u), weights[i], rows, picture);
      for (int b = 0; b < size.height; ++b) seen.image.at(a, b) = picture[static_cast<std::size_t>(b)];
    }
  });
  seen.unlit = unlit;
  return seen;
}

template <class Referral>
Perceived<Referral> perceive_any(const RayDisplay& display, const RayValues<Rgb>& rays,
                                 ObserverPosition observer, PinholeSize size, int threads) {
  size.validate();
  require_rays_of(display, rays.size());
  return display.in_columns() ? perceive_columns<Referral>(display, rays, observer, size, threads)
                              : perceive_pixels<Referral>(display, rays, observer, size, threads);
}

}  // namespace

Perceived<SceneReferred> perceive(const RayDisplay& display, const SceneRays& rays, ObserverPosition observer,
                                  PinholeSize size, int threads) {
  return perceive_any<SceneReferred>(display, rays, observer, size, threads);
}

Perceived<DisplayLight> perceive(const RayDisplay& display, const DisplayRays& rays,
                                 ObserverPosition observer, PinholeSize size, int threads) {
  return perceive_any<DisplayLight>(display, rays, observer, size, threads);
}

Perceived<SceneReferred> perceive_literally(const RayDisplay& display, const SceneRays& rays,
                                            ObserverPosition observer, PinholeSize size) {
  size.validate();
  require_rays_of(display, rays.size());
  return perceive_pixels<SceneReferred>(display, rays, observer, size, 1);
}

}  // namespace plenolab
