#pragma once

#include <optional>

#include "core/image/image.h"
#include "core/tonemap/filters/bilateral_filter.h"
#include "core/tonemap/filters/bounds.h"

namespace plenolab {

/// What a bilateral filter works on, checked: options in range, all planes of one size, all values usable
/// (see bounds.h). A depth guide that cannot change a weight is left out, so that its result is that without
/// one. Planes and options are not owned.
class BilateralInput {
 public:
  BilateralInput(const Plane<float>& filtered, const Plane<float>& range_of, const BilateralOptions& widths,
                 const std::optional<DepthGuide>& guide, int thread_count);

  const Plane<float>& value;
  const Plane<float>& range;
  const BilateralOptions& options;
  std::optional<DepthGuide> depth;
  int threads;
  Bounds value_bounds, range_bounds, disparity_bounds;  ///< the last one only with a depth guide

  int width() const { return value.width(); }
  int height() const { return value.height(); }
  /// Half the side of the window in whole pixels, never more than the image needs.
  int radius_px() const;
};

/// Evaluates every term of the sums.
Plane<float> filter_exactly(const BilateralInput& input);

}  // namespace plenolab
