#pragma once

#include <cstdint>

#include "core/image/image.h"
#include "core/image/repair.h"

namespace plenolab {

/// What had to be changed on the way from a scene-referred view to display values; nothing is cut silently.
struct MappingCounts {
  PixelRepairs repairs;             ///< channel values of the input that were NaN, infinite or negative
  std::int64_t floored_pixels = 0;  ///< luminance 0: the log floor of the light field was used for it
  std::int64_t clipped_high = 0;    ///< channel values above 1 that were cut to 1
  std::int64_t clipped_low = 0;     ///< channel values (or luma) below 0 that were cut to 0
  MappingCounts& operator+=(const MappingCounts& other);
  friend bool operator==(const MappingCounts&, const MappingCounts&) = default;
};

/// A display-referred image, code values in [0, 1], and what was changed to get it.
struct ToneMapped {
  DisplayImage image;
  MappingCounts counts;
};

}  // namespace plenolab
