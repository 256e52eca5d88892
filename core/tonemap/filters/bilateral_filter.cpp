#include "core/tonemap/filters/bilateral_filter.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/tonemap/filters/bilateral_grid.h"
#include "core/tonemap/filters/bilateral_input.h"

namespace plenolab {
namespace {

/// Widths outside would leave float in the exponents of the weights; no image has such values.
constexpr double kSmallestSigma = 1e-9, kLargestSigma = 1e9;

void require_sigma(double sigma, const char* what) {
  if (!(sigma >= kSmallestSigma && sigma <= kLargestSigma))
    throw InputError(
        fmt::format("{} must be between {} and {}, not {}", what, kSmallestSigma, kLargestSigma, sigma));
}

template <class Method>
Plane<float> filter(const Plane<float>& value, const Plane<float>& range, const BilateralOptions& options,
                    const std::optional<DepthGuide>& depth, int threads, const Method& method) {
  const BilateralInput input(value, range, options, depth, threads);
  if (input.value_bounds.min == input.value_bounds.max) return value;  // constant or empty
  return method(input);
}

Plane<float> filter_fast(const BilateralInput& input) {
  std::optional<Plane<float>> result = filter_by_grid(input, {}, GridUse::kIfCheaper);
  return result ? *std::move(result) : filter_exactly(input);
}

}  // namespace

void BilateralOptions::validate() const {
  require_sigma(sigma_s_px, "the bilateral filter's sigma in pixels");
  require_sigma(sigma_value, "the bilateral filter's sigma of the values");
  if (!(support_sigmas >= 1 && support_sigmas <= 10))
    throw InputError(
        fmt::format("the support of the bilateral filter must be 1 to 10 sigmas, not {}", support_sigmas));
}

void DepthGuide::validate() const {
  require_sigma(sigma_d_px, "the bilateral filter's sigma of the disparity");
}

double default_sigma_s_px(int width, int height) {
  return 0.02 * std::max(width, height);
}

Plane<float> bilateral_exact(const Plane<float>& value, const BilateralOptions& options,
                             const std::optional<DepthGuide>& depth, int threads) {
  return filter(value, value, options, depth, threads, filter_exactly);
}

Plane<float> bilateral_fast(const Plane<float>& value, const BilateralOptions& options,
                            const std::optional<DepthGuide>& depth, int threads) {
  return filter(value, value, options, depth, threads, filter_fast);
}

Plane<float> cross_bilateral_exact(const Plane<float>& value, const Plane<float>& range,
                                   const BilateralOptions& options, const std::optional<DepthGuide>& depth,
                                   int threads) {
  return filter(value, range, options, depth, threads, filter_exactly);
}

Plane<float> cross_bilateral_fast(const Plane<float>& value, const Plane<float>& range,
                                  const BilateralOptions& options, const std::optional<DepthGuide>& depth,
                                  int threads) {
  return filter(value, range, options, depth, threads, filter_fast);
}

}  // namespace plenolab
