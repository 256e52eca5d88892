#include "core/tonemap/filters/bilateral_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/filters/gaussian.h"

namespace plenolab {
namespace {

Bounds checked_bounds(const Plane<float>& plane, const char* what) {
  const Bounds bounds = bounds_of(plane);
  PLENOLAB_CHECK(bounds.usable,
                 fmt::format("a {} of a bilateral filter is NaN or beyond {}", what, kLargestFiltered));
  return bounds;
}

void check_size(const Plane<float>& plane, const Plane<float>& value, const char* what) {
  PLENOLAB_CHECK(plane.width() == value.width() && plane.height() == value.height(),
                 fmt::format("{}×{} values of {}, {}×{} to filter", plane.width(), plane.height(), what,
                             value.width(), value.height()));
}

/// Whether the largest difference on the map still has the weight 1, as a float.
bool weighs_nothing(double sigma_d_px, const Bounds& disparity) {
  constexpr double kBelowHalfUlp = 0x1.0p-26;
  return gaussian_exponent(sigma_d_px) * disparity.range() * disparity.range() < kBelowHalfUlp;
}

}  // namespace

BilateralInput::BilateralInput(const Plane<float>& filtered, const Plane<float>& range_of,
                               const BilateralOptions& widths, const std::optional<DepthGuide>& guide,
                               int thread_count)
    : value(filtered), range(range_of), options(widths), threads(thread_count) {
  options.validate();
  check_size(range, value, "range");
  if (guide) {
    guide->validate();
    PLENOLAB_CHECK(guide->disparity != nullptr, "a depth guide without a disparity map");
    check_size(*guide->disparity, value, "disparity");
  }
  if (value.empty()) return;
  value_bounds = checked_bounds(value, "value");
  range_bounds = &range == &value ? value_bounds : checked_bounds(range, "range");
  if (!guide) return;
  disparity_bounds = checked_bounds(*guide->disparity, "disparity");
  if (!weighs_nothing(guide->sigma_d_px, disparity_bounds)) depth = guide;
}

int BilateralInput::radius_px() const {
  const int largest = std::max(width(), height()) - 1;
  return static_cast<int>(std::min<double>(largest, std::ceil(options.support_sigmas * options.sigma_s_px)));
}

}  // namespace plenolab
