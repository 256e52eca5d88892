#pragma once

#include <cstdint>
#include <span>

#include "core/image/image.h"

namespace plenolab {

/// Channel values that were cut.
struct CutCounts {
  std::int64_t high = 0, low = 0;
};

/// v ← min(max((v − offset)·gain, 0), 1) for every channel; counts what lay outside.
CutCounts normalise_row(std::span<Rgb> row, float offset, float gain);

/// Three straight lines through (0, 0), (low, luma_low), (high, luma_high), (1, 1), 0 ≤ low ≤ high ≤ 1; a
/// line without width is left out.
struct ThreeLines {
  float low = 0, luma_low = 0, high = 1, luma_high = 1;
};

/// c ← l'·(c/l)^colour_exponent for every channel c of pixels of luma l, with l' = lines(l) (1 in place of
/// c/l where l is 0). Colours of which a channel would exceed 1 are drawn towards grey of luma l' until it
/// is 1. Channels in [0, 1] before and after.
void three_lines_row(std::span<Rgb> row, const ThreeLines& lines, double colour_exponent);

}  // namespace plenolab
