#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/random.h"
#include "core/image/image.h"

namespace plenolab {

/// Log luminance and disparity of a made-up view.
struct FilterImage {
  Plane<float> value;
  DisparityMap disparity;
};

inline double noise(std::uint64_t purpose, int x, int y) {
  return unit_double(
      random_u64(5, purpose, (static_cast<std::uint64_t>(y) << 32) | static_cast<std::uint64_t>(x)));
}

/// Slanted ground with waves and a step in brightness, discs in front of it over six decades, noise, and lone
/// pixels three decades brighter.
inline FilterImage discs_before_ground(int width, int height) {
  FilterImage image{Plane<float>(width, height), DisparityMap(width, height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double value =
          3.0 * x / width + (2 * y > height ? 1.0 : 0.0) + 0.3 * std::sin(0.1 * x) * std::cos(0.07 * y);
      double disparity = 2 + 10.0 * y / height;
      for (std::uint64_t n = 0; n < 12; ++n) {
        const double cx = width * unit_double(random_u64(1, 2, n)),
                     cy = height * unit_double(random_u64(1, 3, n));
        if (std::hypot(x - cx, y - cy) > width * (0.02 + 0.06 * unit_double(random_u64(1, 4, n)))) continue;
        disparity = 12 + 20 * unit_double(random_u64(1, 5, n));
        value = -1 + 6 * unit_double(random_u64(1, 6, n));
      }
      value += 0.3 * noise(1, x, y) + (noise(2, x, y) < 0.001 ? 3.0 : 0.0);
      image.value.at(x, y) = static_cast<float>(value);
      image.disparity.at(x, y) = static_cast<float>(disparity);
    }
  return image;
}

/// A near half on the left (disparity 8, `near_value`) and a far half (disparity 1, `far_value`).
inline FilterImage depth_step(int width, int height, float near_value, float far_value) {
  FilterImage image{Plane<float>(width, height, far_value), DisparityMap(width, height, 1.0f)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width / 2; ++x) {
      image.value.at(x, y) = near_value;
      image.disparity.at(x, y) = 8;
    }
  return image;
}

struct Difference {
  double mean = 0, max = 0;
};

inline Difference difference(const Plane<float>& a, const Plane<float>& b) {
  Difference d;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double e = std::abs(static_cast<double>(a.pixels()[i]) - static_cast<double>(b.pixels()[i]));
    d.mean += e / static_cast<double>(a.size());
    d.max = std::max(d.max, e);
  }
  return d;
}

}  // namespace plenolab
