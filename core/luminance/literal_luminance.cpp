#include <cmath>

#include "core/luminance/luminance_samples.h"
#include "core/luminance/point_rays.h"

// The definitions by the letter, kept as the reference of the tests and benchmarks; also what displays
// without upright columns use.

namespace plenolab {

namespace {

/// Adds one pixel or ray.
void count(double luminance, double weight, const LogAverageOptions& average, LogSum& sum) {
  const bool offset = average.rule == LogAverageOptions::Rule::kOffset;
  if (!offset && !(luminance > average.epsilon)) return;
  sum += {weight * std::log(offset ? luminance + average.delta : luminance), weight};
}

/// Rays that light a point and reach the observer, with their weights.
void rays_reaching(const RayDisplay& display, ScreenPoint point, ObserverPosition observer,
                   std::vector<Ray>& rays, std::vector<double>& weights) {
  rays.clear();
  weights.clear();
  display.rays_at(point, rays);
  for (const Ray& ray : rays) weights.push_back(display.weight(ray, observer));
}

template <class Body>
void for_each_ray(const RayCount& size, const Body& body) {
  for (int image = 0; image < size.images; ++image)
    for (int u = 0; u < size.width; ++u)
      for (int v = 0; v < size.height; ++v) body(Ray{image, u, v});
}

std::vector<LogSum> literal_sums(const RayDisplay& display, const RayValues<float>& luminance,
                                 const ObserverSamples& samples, const LuminanceOptions& options) {
  std::vector<LogSum> sums(static_cast<std::size_t>(samples.size()));
  if (options.method == LuminanceMethod::kAccumulative) {
    sums = literal_accumulation(display, luminance, samples, options.average);
    return options.smoothed ? smoothed_sums(samples, sums) : sums;
  }
  if (options.method == LuminanceMethod::kAll) {
    LogSum all;
    for_each_ray(luminance.size(), [&](const Ray& ray) {
      count(static_cast<double>(luminance.at(ray)), 1, options.average, all);
    });
    return std::vector<LogSum>(sums.size(), all);
  }
  for (int j = 0; j < samples.size(); ++j)
    sums[static_cast<std::size_t>(j)] =
        options.method == LuminanceMethod::kBruteForce
            ? literal_brute_force(display, luminance, samples.position(j), options.pinhole, options.average)
            : literal_spread(display, luminance, samples.position(j), options.normalised_spread,
                             options.average);
  return sums;
}

}  // namespace

LogSum literal_brute_force(const RayDisplay& display, const RayValues<float>& luminance,
                           ObserverPosition observer, PinholeSize size, const LogAverageOptions& average) {
  LogSum sum;
  std::vector<Ray> rays;
  std::vector<double> weights;
  for (int b = 0; b < size.height; ++b)
    for (int a = 0; a < size.width; ++a) {
      rays_reaching(display, size.middle(a, b), observer, rays, weights);
      if (!normalise(std::span(weights))) continue;
      double seen = 0;
      for (std::size_t i = 0; i < rays.size(); ++i)
        seen += weights[i] * static_cast<double>(luminance.at(rays[i]));
      count(seen, 1, average, sum);
    }
  return sum;
}

LogSum literal_spread(const RayDisplay& display, const RayValues<float>& luminance, ObserverPosition observer,
                      bool normalised, const LogAverageOptions& average) {
  LogSum sum;
  std::vector<Ray> rays;
  std::vector<double> weights;
  const PinholeSize size = display.resolution();
  for (int b = 0; b < size.height; ++b)
    for (int a = 0; a < size.width; ++a) {
      rays_reaching(display, size.middle(a, b), observer, rays, weights);
      if (normalised && !normalise(std::span(weights))) continue;
      for (std::size_t i = 0; i < rays.size(); ++i)
        if (weights[i] > 0) count(static_cast<double>(luminance.at(rays[i])), weights[i], average, sum);
    }
  return sum;
}

std::vector<LogSum> literal_accumulation(const RayDisplay& display, const RayValues<float>& luminance,
                                         const ObserverSamples& samples, const LogAverageOptions& average) {
  std::vector<LogSum> sums(static_cast<std::size_t>(samples.size()));
  for_each_ray(luminance.size(), [&](const Ray& ray) {
    const int nearest = samples.nearest(display.position(ray));
    if (nearest >= 0)
      count(static_cast<double>(luminance.at(ray)), 1, average, sums[static_cast<std::size_t>(nearest)]);
  });
  return sums;
}

GlobalLuminance estimate_luminance_literally(const RayDisplay& display, const RayValues<float>& luminance,
                                             const ObserverSamples& samples,
                                             const LuminanceOptions& options) {
  require_estimable(display, luminance, samples, options);
  return finish_samples(samples, literal_sums(display, luminance, samples, options));
}

}  // namespace plenolab
