#include "core/tonemap/filters/bilateral_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/filters/bilateral_grid.h"
#include "core/tonemap/filters/bilateral_methods.h"
#include "core/tonemap/filters/gaussian.h"

namespace plenolab {
namespace {

/// Widths outside would leave float in the exponents of the weights; no image has such values.
constexpr double kSmallestSigma = 1e-9, kLargestSigma = 1e9;
/// Squares of differences of larger values would overflow.
constexpr float kLargestValue = 1e18f;

void require_sigma(double sigma, const char* what) {
  if (!(sigma >= kSmallestSigma && sigma <= kLargestSigma))
    throw InputError(
        fmt::format("{} must be between {} and {}, not {}", what, kSmallestSigma, kLargestSigma, sigma));
}

void check_values(const Plane<float>& plane, const char* what) {
  for (const float v : plane.pixels())
    PLENOLAB_CHECK(std::abs(v) <= kLargestValue, fmt::format("{} {} in a bilateral filter", what, v));
}

/// Whether the largest difference on the map still has the weight 1, as a float.
bool weighs_nothing(const DepthGuide& depth) {
  const auto [min, max] =
      std::minmax_element(depth.disparity->pixels().begin(), depth.disparity->pixels().end());
  const double difference = static_cast<double>(*max) - static_cast<double>(*min);
  constexpr double kBelowHalfUlp = 0x1.0p-26;
  return gaussian_exponent(depth.sigma_d_px) * difference * difference < kBelowHalfUlp;
}

template <class T>
bool constant(const Plane<T>& plane) {
  return std::all_of(plane.pixels().begin(), plane.pixels().end(),
                     [&](T v) { return v == plane.pixels()[0]; });
}

void check(const BilateralInput& input) {
  input.options.validate();
  PLENOLAB_CHECK(input.range.width() == input.width() && input.range.height() == input.height(),
                 fmt::format("range {}×{}", input.range.width(), input.range.height()));
  check_values(input.value, "value");
  if (&input.range != &input.value) check_values(input.range, "range");
  if (!input.depth) return;
  input.depth->validate();
  PLENOLAB_CHECK(input.depth->disparity != nullptr, "a depth guide without a disparity map");
  const DisparityMap& disparity = *input.depth->disparity;
  PLENOLAB_CHECK(disparity.width() == input.width() && disparity.height() == input.height(),
                 fmt::format("disparity {}×{}", disparity.width(), disparity.height()));
  check_values(disparity, "disparity");
}

template <class Method>
Plane<float> filter(const Plane<float>& value, const Plane<float>& range, const BilateralOptions& options,
                    const std::optional<DepthGuide>& depth, int threads, const Method& method) {
  check({value, range, options, depth, threads});
  if (value.empty() || constant(value)) return value;
  if (depth && weighs_nothing(*depth)) return method({value, range, options, std::nullopt, threads});
  return method({value, range, options, depth, threads});
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

int window_radius_px(const BilateralOptions& options, int width, int height) {
  const int largest = std::max(width, height) - 1;
  return static_cast<int>(std::min<double>(largest, std::ceil(options.support_sigmas * options.sigma_s_px)));
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
