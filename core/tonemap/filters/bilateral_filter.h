#pragma once

#include <optional>

#include "core/image/image.h"

namespace plenolab {

/// Widths of the bilateral filter (Tomasi & Manduchi 1998; thesis of Altmeier, section 5.1.2): G_σ(x) =
/// exp(−x²/2σ²) of the distance in the image and of the difference in value.
struct BilateralOptions {
  double sigma_s_px = 10;  ///< of the distance, pixels, > 0
  double sigma_value =
      0.4;  ///< of the difference, in the unit of the values (log10 units for luminance), > 0
  double support_sigmas = 3;  ///< the window reaches this many σ_s to each side (a square), in [1, 10]

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// The default σ_s of the operators and of the key-view adjustment: 2 % of the larger side, in pixels.
double default_sigma_s_px(int width, int height);

/// Which pixels q a pixel p may take from across a depth edge.
enum class DepthSide {
  kTwoSided,  ///< G(disp(p) − disp(q)): nothing crosses the edge (enhanced base layer, section 5.1.3)
  /// G(max(disp(q) − disp(p), 0)): the background takes nothing from the foreground, the foreground takes
  /// from the background as if there were no edge (temporary layer, section 5.1.3, with the sign of its
  /// text).
  kBackgroundTakesNothingFromForeground,
};

/// The disparity weight of the enhanced bilateral operator.
struct DepthGuide {
  const DisparityMap* disparity = nullptr;  ///< of the same size as the values; not owned
  double sigma_d_px = 0.5;                  ///< pixels of disparity, > 0
  DepthSide side = DepthSide::kTwoSided;

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// Weighted mean of the values around each pixel: Σ_q W(p, q)·value(q) / Σ_q W(p, q) with W = G_σs(|p − q|) ·
/// G_σv(value(p) − value(q)) · the weight of `depth`, if given; sums over the square window cut off by the
/// image border. Every term is evaluated: the reference, O(support²) per pixel. Results lie between the
/// smallest and largest value of the window. Values and disparities must be finite (a bug otherwise).
/// With a disparity map whose range cannot change any weight the result is, bit by bit, that without one.
Plane<float> bilateral_exact(const Plane<float>& value, const BilateralOptions& options,
                             const std::optional<DepthGuide>& depth = std::nullopt, int threads = 0);

/// The same filter, approximately, in time that does not depend on σ_s: see bilateral_grid.h for how, and
/// for the errors against bilateral_exact. Small windows and widths that need too large a grid are
/// evaluated exactly. The same bits for any number of threads.
Plane<float> bilateral_fast(const Plane<float>& value, const BilateralOptions& options,
                            const std::optional<DepthGuide>& depth = std::nullopt, int threads = 0);

/// Cross bilateral filters: `value` is averaged, the range weight is that of `range` (its unit is that of
/// sigma_value). Both of the same size. The filters above are these with range = value.
Plane<float> cross_bilateral_exact(const Plane<float>& value, const Plane<float>& range,
                                   const BilateralOptions& options,
                                   const std::optional<DepthGuide>& depth = std::nullopt, int threads = 0);
Plane<float> cross_bilateral_fast(const Plane<float>& value, const Plane<float>& range,
                                  const BilateralOptions& options,
                                  const std::optional<DepthGuide>& depth = std::nullopt, int threads = 0);

}  // namespace plenolab
