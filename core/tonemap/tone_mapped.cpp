#include "core/tonemap/tone_mapped.h"

namespace plenolab {

MappingCounts& MappingCounts::operator+=(const MappingCounts& other) {
  repairs.nan += other.repairs.nan;
  repairs.positive_infinity += other.repairs.positive_infinity;
  repairs.negative += other.repairs.negative;
  floored_pixels += other.floored_pixels;
  clipped_high += other.clipped_high;
  clipped_low += other.clipped_low;
  return *this;
}

}  // namespace plenolab
