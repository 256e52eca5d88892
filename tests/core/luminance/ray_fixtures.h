#pragma once

#include <cmath>
#include <functional>

#include "core/base/random.h"
#include "core/luminance/lens_array_display.h"
#include "core/luminance/multi_view_display.h"
#include "core/luminance/projector_display.h"
#include "core/luminance/ray_images.h"

namespace plenolab {

/// A small projector display: 12 projectors of 40 × 20 pixels.
inline ProjectorDisplay small_projectors(int projectors = 12, int width = 40, int height = 20) {
  return ProjectorDisplay({.projectors = projectors, .width = width, .height = height});
}

/// Luminance as a function of the ray.
template <class Function>
RayValues<float> luminance_by(const RayDisplay& display, const Function& function) {
  RayValues<float> values(display.size());
  for (int k = 0; k < display.size().images; ++k)
    for (int u = 0; u < display.size().width; ++u)
      for (int v = 0; v < display.size().height; ++v)
        values.at({k, u, v}) = static_cast<float>(function(Ray{k, u, v}));
  return values;
}

/// Hashed luminances, evenly spread in their logarithm over 10^low … 10^high; a share is black.
inline RayValues<float> random_luminance(const RayDisplay& display, double low, double high,
                                         double black = 0) {
  std::uint64_t index = 0;
  return luminance_by(display, [&](const Ray&) {
    const double chance = unit_double(random_u64(1, 0x6c756d, index));
    const double value = std::pow(10.0, low + (high - low) * unit_double(random_u64(2, 0x6c756d, index++)));
    return chance < black ? 0.0 : value;
  });
}

}  // namespace plenolab
