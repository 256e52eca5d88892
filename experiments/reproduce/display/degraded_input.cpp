#include "experiments/reproduce/display/degraded_input.h"

#include <algorithm>
#include <cmath>

namespace plenolab {

float coded_depth(float depth_m, const DepthCoding& coding) {
  constexpr double kNear = kCodedNear_m, kFar = kCodedFar_m;
  const bool linear = coding.scale == DepthCoding::Scale::kLinear;
  const double z = std::clamp(static_cast<double>(depth_m), kNear, kFar);
  double v = linear ? (z - kNear) / (kFar - kNear) : kFar / (kFar - kNear) * (1 - kNear / z);
  if (coding.bits > 0) {
    const double steps = std::pow(2.0, coding.bits) - 1;
    v = std::round(v * steps) / steps;
  } else {
    v = static_cast<double>(static_cast<float>(v));
  }
  return static_cast<float>(linear ? kNear + v * (kFar - kNear) : kNear / (1 - v * (kFar - kNear) / kFar));
}

RenderedCamera anti_aliased(const RenderedCamera& sharp, const RenderedCamera& fine, bool depth_too) {
  RenderedCamera camera = sharp;
  for (int y = 0; y < camera.colour.height(); ++y)
    for (int x = 0; x < camera.colour.width(); ++x) {
      const auto mean = [&](const auto& p) {
        return (p.at(2 * x, 2 * y) + p.at(2 * x + 1, 2 * y) + p.at(2 * x, 2 * y + 1) +
                p.at(2 * x + 1, 2 * y + 1)) *
               0.25f;
      };
      camera.colour.at(x, y) = mean(fine.colour);
      if (depth_too) camera.depth_m.at(x, y) = mean(fine.depth_m);
    }
  return camera;
}

double stray_share(const Plane<float>& disparity_px, const Plane<float>& true_px, int n) {
  double stray = 0, matched = 0;
  const auto is_near = [](float taken, float truth) {
    return std::abs(taken - truth) <= 0.05f * truth + 1e-6f;
  };
  const auto around_has = [&](int x, int y, float taken) {
    for (int j = std::max(y - 1, y / n * n); j <= std::min(y + 1, y / n * n + n - 1); ++j)
      for (int i = std::max(x - 1, x / n * n); i <= std::min(x + 1, x / n * n + n - 1); ++i)
        if (is_near(taken, true_px.at(i, j))) return true;
    return false;
  };
  for (int y = 0; y < true_px.height(); ++y)
    for (int x = 0; x < true_px.width(); ++x) {
      const float taken = disparity_px.at(x, y);
      if (taken < 0) continue;
      ++matched;
      stray += !around_has(x, y, taken);
    }
  return stray / std::max(matched, 1.0);
}

}  // namespace plenolab
