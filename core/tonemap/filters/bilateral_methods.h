#pragma once

#include <optional>

#include "core/image/image.h"
#include "core/tonemap/filters/bilateral_filter.h"

namespace plenolab {

/// What a bilateral filter works on, checked and pruned: `range` differs somewhere or `depth` weights do, all
/// planes have one size and finite values. Planes are not owned.
struct BilateralInput {
  const Plane<float>& value;
  const Plane<float>& range;
  const BilateralOptions& options;
  const std::optional<DepthGuide>& depth;
  int threads;

  int width() const { return value.width(); }
  int height() const { return value.height(); }
};

/// Half the side of the window in whole pixels, never more than the image needs.
int window_radius_px(const BilateralOptions& options, int width, int height);

/// Every term of the sums.
Plane<float> filter_exactly(const BilateralInput& input);

}  // namespace plenolab
