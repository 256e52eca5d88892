#pragma once

#include <vector>

#include "core/lut/lut.h"

namespace plenolab {

/// One-dimensional look-up tables: a curve for each channel, given at equally spaced inputs. They change
/// tones and cannot mix channels.
struct LutCurves {
  Rgb domain_min{0, 0, 0}, domain_max{1, 1, 1};  ///< inputs of the first and last nodes, by channel
  std::vector<Rgb> nodes;                        ///< outputs, each channel its own; at least two

  /// Outputs of one colour, linear between nodes; outside the domain those of its ends, NaN counts as the
  /// lower end.
  Rgb operator()(Rgb colour) const;
};

/// Nodes of a lattice along each axis that stands for curves with more of them.
inline constexpr int kCurveLatticeSize = 65;

/// The lattice of curves, followed by the table `behind` if there is one (a shaper before a lattice): over
/// the curves' domain, with `size` nodes along each axis. 0: as many as the curves have, which keeps them
/// exactly, but at most kCurveLatticeSize (or as many as `behind` has), which cuts corners where curves bend
/// sharply; behind curves never fewer than that.
Lut lut_of_curves(const LutCurves& curves, const Lut* behind = nullptr, int size = 0);

}  // namespace plenolab
