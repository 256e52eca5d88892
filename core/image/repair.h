#pragma once

#include <cstdint>

#include "core/image/image.h"

namespace plenolab {

/// How many channel values of an image had to be replaced, by kind.
struct PixelRepairs {
  std::int64_t nan = 0;                ///< NaN → 0
  std::int64_t positive_infinity = 0;  ///< +Inf → largest finite value of the image (0 if there is none)
  std::int64_t negative = 0;           ///< negative finite values and −Inf → 0
  std::int64_t total() const { return nan + positive_infinity + negative; }
  friend bool operator==(const PixelRepairs&, const PixelRepairs&) = default;
};

/// Largest finite channel value of an image; 0 if none is positive. What +Inf becomes.
float largest_finite(const SceneImage& image);

/// One channel value after repair: 0 for NaN and negative ones, `largest` for +Inf, else itself.
float repaired_value(float value, float largest);

/// Counts what `repair` would replace.
PixelRepairs count_defects(const SceneImage& image);

/// Replaces NaN, infinite and negative channel values so that every value is finite and ≥ 0, and says how
/// many.
PixelRepairs repair(SceneImage& image);

}  // namespace plenolab
