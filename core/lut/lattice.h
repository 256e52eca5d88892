#pragma once

#include "core/lut/lut.h"

namespace plenolab {

/// Where a colour lies on the lattice of a look-up table; shared by the definition (sample_lut) and the fast
/// rows (grade), so that both agree on every rounding.

/// Node positions are (value − low)·scale, cut to 0 … last, by channel.
struct Lattice {
  Rgb low, scale;
  float last = 1;  ///< size − 1
};

inline Lattice lattice_of(const Lut& lut) {
  const auto last = static_cast<float>(lut.size - 1);
  const Rgb range = lut.domain_max - lut.domain_min;
  return {lut.domain_min, {last / range.r, last / range.g, last / range.b}, last};
}

struct AxisPosition {
  int node = 0;        ///< 0 … size − 1
  float fraction = 0;  ///< [0, 1) of the way to the next node; 0 at the last node
};

struct Cell {
  AxisPosition r, g, b;
};

/// NaN fails the first comparison and counts as the lower end.
inline AxisPosition position_on(float value, float low, float scale, float last) {
  const float position = (value - low) * scale;
  const float cut = position > 0 ? (position < last ? position : last) : 0;
  const int node = static_cast<int>(cut);
  return {node, cut - static_cast<float>(node)};
}

inline Cell cell_of(const Lattice& lattice, Rgb c) {
  return {position_on(c.r, lattice.low.r, lattice.scale.r, lattice.last),
          position_on(c.g, lattice.low.g, lattice.scale.g, lattice.last),
          position_on(c.b, lattice.low.b, lattice.scale.b, lattice.last)};
}

}  // namespace plenolab
