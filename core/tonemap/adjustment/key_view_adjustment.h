#pragma once

#include <cstdint>
#include <functional>

#include "core/base/progress.h"
#include "core/image/image.h"
#include "core/lightfield/light_field.h"
#include "core/tonemap/filters/bilateral_filter.h"

namespace plenolab {

/// Key-view adjustment (thesis of Altmeier, section 5.3): draws the luma of corresponding pixels of tone
/// mapped key views together, so that views synthesised from them show no borders, and leaves differences
/// that are in the HDR views too (material, media) and those over large distances on the camera plane.
struct KeyViewAdjustmentOptions {
  double sigma_views = 2;            ///< of the distance of key views, in key views, > 0
  double support_views = 8;          ///< key views farther apart than this have no weight; in views, ≥ 0
  double sigma_d_px = 0.5;           ///< of the difference in disparity, pixels, > 0
  double sigma_log_luminance = 0.1;  ///< of the difference in HDR luminance, log10 units, > 0
  /// The second filter, which smooths the factors inside a view.
  double smoothing_share = 0.02;               ///< its σ_s as a share of the larger side of the view, > 0
  double smoothing_sigma_d_px = 0.5;           ///< two-sided disparity weight, pixels, > 0
  double smoothing_sigma_log_luminance = 0.1;  ///< HDR luminance, log10 units, > 0

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// What was done to a view or, added up, to a light field.
struct KeyViewAdjustmentStatistics {
  std::int64_t pixels = 0;
  std::int64_t correspondences = 0;  ///< pixels of other views looked into (inside their image)
  std::int64_t kept_dark = 0;        ///< pixels with luma < 1/1024: factor 1 before smoothing
  std::int64_t clipped = 0;          ///< channel values above 1 after the factor, set to 1
  std::int64_t floored = 0;          ///< HDR pixels without positive luminance: the smallest positive one
  KeyViewAdjustmentStatistics& operator+=(const KeyViewAdjustmentStatistics& other);
};

/// Receives the adjusted views, row by row in order of (row, column), each exactly once, from one thread.
using AdjustedViewSink = std::function<void(int column, int row, const DisplayImage& view)>;

}  // namespace plenolab
