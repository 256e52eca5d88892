#pragma once

#include <cstdint>
#include <span>

#include "core/image/image.h"

namespace plenolab {

/// Exponent of the colour ratio where an operator does not say otherwise: the middle of the range 0.5 … 0.9
/// the thesis names (section 5.1.4).
inline constexpr double kColourExponent = 0.7;

/// Colour for operators that map luminance to luma (thesis, sections 2.1.2 and 5.1.4):
///   out = luma_out · (C / L)^exponent,
/// ratio 1 where L = 0. Values above 1 become 1.
///
/// `scene`: linear RGB, finite and ≥ 0, any unit. `luma`: display luma ≥ 0, finite. `out`: code values in [0,
/// 1]. All of equal length; `out` may not overlap `scene`. `exponent` in [0, 1]: 1 keeps the ratios of linear
/// light in the encoded values (over-saturated), 0 gives grey, 1/2.2 equals encoding C·L_out/L by gamma. A
/// colourless pixel comes out exactly colourless. Returns how many channel values were above 1. Runs of
/// colourless pixels are evaluated for one channel; `prune` false evaluates all three, to the same bits.
std::int64_t apply_colour_ratio(std::span<const Rgb> scene, std::span<const float> luma, double exponent,
                                std::span<Rgb> out, bool prune = true);

}  // namespace plenolab
