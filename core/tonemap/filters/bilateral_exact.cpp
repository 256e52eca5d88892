#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/parallel.h"
#include "core/tonemap/filters/bilateral_input.h"
#include "core/tonemap/filters/gaussian.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/filters/bilateral_exact.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/filters/gaussian-inl.h"

#ifndef PLENOLAB_BILATERAL_EXACT_ONCE
#define PLENOLAB_BILATERAL_EXACT_ONCE
namespace plenolab {

/// Planes with `radius` columns on both sides whose range lies infinitely far away, and so weigh nothing;
/// on the right further columns up to whole vectors.
struct ExactSetup {
  int width = 0, height = 0, radius = 0;
  Plane<float> value, range, disparity;  ///< disparity empty without a depth guide
  std::vector<float> spatial;            ///< exponents of distances 0 … radius
  float value_exponent = 0, disparity_exponent = 0;
  bool one_sided = false;
};

/// Outputs that share their loop over the window, a whole number of vectors.
inline constexpr int kExactLanes = 16;

}  // namespace plenolab
#endif

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

enum class DepthWeight { kNone, kTwoSided, kOneSided };

using ExactTag = hn::CappedTag<float, kExactLanes>;
using ExactVec = hn::Vec<ExactTag>;

/// Sums of the weights and of the weighted differences to the pixel's own value.
struct WindowSums {
  ExactVec weight, difference;
};

/// What one row of the window adds for the pixels from x on; `y_exponent` is that of the row's distance.
template <DepthWeight kDepth>
HWY_INLINE WindowSums SumRow(const ExactSetup& s, int x, int y, int row, float y_exponent) {
  const ExactTag d;
  const auto own = [&](const Plane<float>& plane) { return hn::LoadU(d, plane.row(y) + x + s.radius); };
  const ExactVec own_value = own(s.value), own_range = own(s.range);
  ExactVec own_disparity = hn::Zero(d);
  if constexpr (kDepth != DepthWeight::kNone) own_disparity = own(s.disparity);
  WindowSums sums{hn::Zero(d), hn::Zero(d)};
  for (int dx = -s.radius; dx <= s.radius; ++dx) {
    const int column = x + dx + s.radius;
    const float distance = y_exponent + s.spatial[static_cast<std::size_t>(std::abs(dx))];
    const ExactVec range = hn::Sub(hn::LoadU(d, s.range.row(row) + column), own_range);
    ExactVec e = hn::Add(hn::Set(d, distance), hn::Mul(hn::Mul(range, range), hn::Set(d, s.value_exponent)));
    if constexpr (kDepth != DepthWeight::kNone) {
      ExactVec nearer = hn::Sub(hn::LoadU(d, s.disparity.row(row) + column), own_disparity);
      if constexpr (kDepth == DepthWeight::kOneSided) nearer = hn::Max(nearer, hn::Zero(d));
      e = hn::Add(e, hn::Mul(hn::Mul(nearer, nearer), hn::Set(d, s.disparity_exponent)));
    }
    const ExactVec weight = NegativeExp2(d, e);
    const ExactVec difference = hn::Sub(hn::LoadU(d, s.value.row(row) + column), own_value);
    sums.weight = hn::Add(sums.weight, weight);
    sums.difference = hn::Add(sums.difference, hn::Mul(weight, difference));
  }
  return sums;
}

template <DepthWeight kDepth>
void FilterRowOf(const ExactSetup& s, int y, float* out) {
  const ExactTag d;
  const int first = std::max(0, y - s.radius), last = std::min(s.height - 1, y + s.radius);
  for (int x = 0; x < s.width; x += static_cast<int>(hn::Lanes(d))) {
    ExactVec weight = hn::Zero(d), difference = hn::Zero(d);
    for (int row = first; row <= last; ++row) {
      const WindowSums sums =
          SumRow<kDepth>(s, x, y, row, s.spatial[static_cast<std::size_t>(std::abs(row - y))]);
      weight = hn::Add(weight, sums.weight);
      difference = hn::Add(difference, sums.difference);
    }
    alignas(64) float result[kExactLanes];
    const ExactVec own = hn::LoadU(d, s.value.row(y) + x + s.radius);
    hn::Store(hn::Add(own, hn::Div(difference, weight)), d, result);
    std::copy_n(result, std::min<int>(static_cast<int>(hn::Lanes(d)), s.width - x), out + x);
  }
}

void FilterRow(const ExactSetup& s, int y, float* out) {
  if (s.disparity.empty())
    FilterRowOf<DepthWeight::kNone>(s, y, out);
  else if (s.one_sided)
    FilterRowOf<DepthWeight::kOneSided>(s, y, out);
  else
    FilterRowOf<DepthWeight::kTwoSided>(s, y, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {
HWY_EXPORT(FilterRow);

Plane<float> padded(const Plane<float>& plane, int radius, float fill) {
  Plane<float> result(plane.width() + 2 * radius + kExactLanes, plane.height(), fill);
  for (int y = 0; y < plane.height(); ++y) std::copy_n(plane.row(y), plane.width(), result.row(y) + radius);
  return result;
}

ExactSetup make_setup(const BilateralInput& input) {
  ExactSetup s{.width = input.width(), .height = input.height()};
  s.radius = input.radius_px();
  s.value = padded(input.value, s.radius, 0);
  s.range = padded(input.range, s.radius, std::numeric_limits<float>::infinity());
  const double k = gaussian_exponent(input.options.sigma_s_px);
  for (int i = 0; i <= s.radius; ++i) s.spatial.push_back(static_cast<float>(k * i * i));
  s.value_exponent = static_cast<float>(gaussian_exponent(input.options.sigma_value));
  if (!input.depth) return s;
  s.disparity = padded(*input.depth->disparity, s.radius, 0);
  s.disparity_exponent = static_cast<float>(gaussian_exponent(input.depth->sigma_d_px));
  s.one_sided = input.depth->side == DepthSide::kBackgroundTakesNothingFromForeground;
  return s;
}

}  // namespace

Plane<float> filter_exactly(const BilateralInput& input) {
  const ExactSetup setup = make_setup(input);
  Plane<float> result(input.width(), input.height());
  parallel_for(input.height(), 1, input.threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) HWY_DYNAMIC_DISPATCH(FilterRow)(setup, y, result.row(y));
  });
  return result;
}

}  // namespace plenolab
#endif  // HWY_ONCE
