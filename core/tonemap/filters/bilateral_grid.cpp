#include "core/tonemap/filters/bilateral_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/filters/grid_passes.h"

namespace plenolab {
namespace {

/// Up to this distance in σ weights of range and disparity are followed: e^(−6.5²/2) of a window of 10⁵
/// pixels is 1e-4 of the weight of the pixel itself.
constexpr double kReach = 6.5;
/// Beyond, floats have no fractions of a sample left.
constexpr double kMostSamples = 1 << 24;
/// Floats of one copy of the grid.
constexpr std::size_t kMostFloats = std::size_t{1} << 26;

bool fits(const BilateralInput& input, const GridSampling& sampling) {
  if (input.options.sigma_s_px < sampling.per_sigma_s) return false;  // cells would be smaller than pixels
  const BilateralOptions& options = input.options;
  if (input.range_bounds.range() * sampling.per_sigma_value / options.sigma_value > kMostSamples)
    return false;
  return !input.depth ||
         input.disparity_bounds.range() * sampling.per_sigma_d / input.depth->sigma_d_px <= kMostSamples;
}

/// Compares counts, never times: the choice is part of the result. Measured: a float of the grid costs as
/// much as this many terms of the exact sum.
bool cheaper_than_exact(const BilateralInput& input, const GridLayout& layout) {
  const double terms_per_float = input.depth ? 200 : 50;
  const double side = 2.0 * input.radius_px() + 1;
  const double terms = std::min<double>(side, input.width()) * std::min<double>(side, input.height());
  return terms_per_float * static_cast<double>(layout.floats) <
         terms * static_cast<double>(input.value.size());
}

std::vector<float> taps(double sigma, int reach) {
  std::vector<float> result;
  for (int i = 0; i <= reach; ++i)
    result.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
  return result;
}

/// σ in samples less the blur of linear interpolation into the grid and out of it, 1/6 each in variance.
double remaining_sigma(double per_sigma) {
  return std::sqrt(per_sigma * per_sigma - 1.0 / 3);
}

/// The Gaussian cut off where the exact window ends: half a pixel beyond its outermost pixels, half a cell
/// beyond the outermost tap, whose weight takes up the fraction that is left.
std::vector<float> window_taps(const BilateralInput& input, double per_sigma) {
  const double window = input.options.support_sigmas * input.options.sigma_s_px;
  const double reach = (std::ceil(window) + 0.5) * per_sigma / input.options.sigma_s_px - 0.5;
  std::vector<float> result = taps(remaining_sigma(per_sigma), static_cast<int>(std::ceil(reach)));
  result.back() *= static_cast<float>(1 - (std::ceil(reach) - reach));
  return result;
}

}  // namespace

void GridSampling::validate() const {
  for (const double n : {per_sigma_s, per_sigma_value, per_sigma_d})
    if (!(n >= 1 && n <= 64))
      throw InputError(fmt::format("the bilateral grid needs 1 to 64 samples per sigma, not {}", n));
}

GridKernels make_kernels(const BilateralInput& input, const GridSampling& sampling) {
  GridKernels kernels;
  kernels.space = window_taps(input, sampling.per_sigma_s);
  kernels.bin_reach = static_cast<int>(std::ceil(kReach * sampling.per_sigma_value / kBinGroup)) * kBinGroup;
  kernels.bins = taps(remaining_sigma(sampling.per_sigma_value), kernels.bin_reach);
  kernels.layers = {1.0f};
  if (input.depth) {
    const int reach = static_cast<int>(std::ceil(kReach * sampling.per_sigma_d));
    kernels.layers = taps(remaining_sigma(sampling.per_sigma_d), reach);
    kernels.one_sided = input.depth->side == DepthSide::kBackgroundTakesNothingFromForeground;
  }
  return kernels;
}

std::optional<Plane<float>> filter_by_grid(const BilateralInput& input, const GridSampling& sampling,
                                           GridUse use) {
  sampling.validate();
  if (!fits(input, sampling)) return std::nullopt;
  const GridAxes axes = make_axes(input, sampling);
  const GridLayout layout = make_layout(input, axes);
  if (layout.floats > kMostFloats) return std::nullopt;
  if (use == GridUse::kIfCheaper && !cheaper_than_exact(input, layout)) return std::nullopt;
  const Bounds& values = input.value_bounds;
  const GridImage image{input, axes, layout, values.min + 0.5f * (values.max - values.min)};
  return slice(image, blur(layout, splat(image), make_kernels(input, sampling), input.threads));
}

}  // namespace plenolab
