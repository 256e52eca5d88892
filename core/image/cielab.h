#pragma once

#include "core/image/image.h"

namespace plenolab {

/// A colour of CIE 1976 L*a*b* (CIE 15:2004) with the white point of BT.709, D65: L* 0 … 100, a* from green
/// to red, b* from blue to yellow.
struct CieLab {
  double l = 0, a = 0, b = 0;
};

/// From encoded display values (gamma 2.2 of BT.709 primaries, colour.h) in [0, 1]; white is (100, 0, 0).
CieLab lab_of_display(Rgb encoded);

/// The inverse. Colours that no display of BT.709 shows leave [0, 1]; negative light counts as 0.
Rgb display_of_lab(CieLab colour);

/// ΔE*ab of CIE 1976: the distance of two colours.
double delta_e(const CieLab& a, const CieLab& b);

}  // namespace plenolab
