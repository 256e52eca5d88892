#include "stimuli/tracer/medium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plenolab::tracer {

MediumSegment clip_to(const Medium& medium, const Ray& ray, float distance_m) {
  float near_m = 0, far_m = distance_m;
  for (int axis = 0; axis < 3; ++axis) {
    const float o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < medium.min_m[axis] || o > medium.max_m[axis]) return {};
      continue;
    }
    const float a = (medium.min_m[axis] - o) / d, b = (medium.max_m[axis] - o) / d;
    near_m = std::max(near_m, std::min(a, b));
    far_m = std::min(far_m, std::max(a, b));
  }
  return far_m > near_m ? MediumSegment{near_m, far_m} : MediumSegment{};
}

float medium_transmittance(const Medium& medium, const Ray& ray, float distance_m) {
  return std::exp(-extinction_per_m(medium) * clip_to(medium, ray, distance_m).length());
}

float henyey_greenstein(float cosine, float g) {
  const float k = 1.0f + g * g - 2.0f * g * cosine;
  return (1.0f - g * g) / (4.0f * std::numbers::pi_v<float> * k * std::sqrt(k));
}

MediumPoint sample_transmittance(const MediumSegment& segment, float extinction, float u) {
  const float depth = extinction * segment.length();
  if (depth < 1e-4f)  // the exponential is flat to single precision
    return {segment.near_m + u * segment.length(), 1.0f / segment.length()};
  const float lost = -std::expm1(-depth);
  const float inside = std::min(-std::log1p(-u * lost) / extinction, segment.length());
  return {segment.near_m + inside, extinction * std::exp(-extinction * inside) / lost};
}

MediumPoint sample_equiangular(const MediumSegment& segment, const Ray& ray, const Vec3& light_m, float u) {
  const float closest = (light_m - ray.origin).dot(ray.direction);
  // A light on the ray itself would need an infinite density; a tenth of a millimetre beside it does not.
  const float height = std::max(1e-4f, (light_m - ray.origin - closest * ray.direction).norm());
  const float a = std::atan((segment.near_m - closest) / height),
              b = std::atan((segment.far_m - closest) / height);
  const float t = height * std::tan(a + u * (b - a));
  const float distance = std::clamp(closest + t, segment.near_m, segment.far_m);
  if (!(b > a)) return {distance, 1.0f / segment.length()};
  return {distance, height / ((b - a) * (height * height + t * t))};
}

}  // namespace plenolab::tracer
