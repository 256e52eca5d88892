#pragma once

#include <cstdint>
#include <functional>

#include "core/image/image.h"
#include "core/lut/lut.h"

namespace plenolab {

/// Colour transfer: a look-up table that gives a picture the distribution of colours of another (Pitié,
/// Kokaram & Dahyot 2007, iterative distribution transfer), in CIELAB. In each iteration the colours of both
/// are turned by a random rotation and, along each of the three axes, quantiles of one are moved to those of
/// the other by a monotone piecewise linear map. The maps are recorded and replayed on the nodes of a table.

struct ColourTransferOptions {
  int iterations = 20;   ///< ≥ 1; the distance falls by most in the first ten
  int quantiles = 256;   ///< knots of each map, ≥ 2
  int samples = 100000;  ///< pixels taken of each picture, evenly spaced, ≥ 2; all if it has fewer
  int size = kDefaultLutSize;
  double amount = 1;       ///< in [0, 1]: 0 changes nothing, 1 transfers fully
  std::uint64_t seed = 1;  ///< of the rotations

  /// Throws InputError naming the value out of range.
  void validate() const;
};

struct ColourTransfer {
  Lut lut;
  /// The transfer of one encoded colour itself, of which the table holds the nodes: all maps replayed. Pure;
  /// may be called from many threads.
  std::function<Rgb(Rgb)> exact;
  /// Sliced Wasserstein distance of the colours in CIELAB units: mean over 32 fixed directions of the mean
  /// difference of equal quantiles, over up to 20000 evenly spaced pixels of each picture, whatever was
  /// fitted to. Before, after the transfer itself, and after grading by the table (tetrahedral).
  double distance_before = 0, distance_unbaked = 0, distance_after = 0;
};

/// Table that brings `source` to the colours of `target`. Deterministic. Colours beyond those of the source
/// move like the nearest end. Outputs are cut to [0, 1]. Throws InputError for options out of range or an
/// empty picture.
ColourTransfer transfer_colours(const DisplayImage& source, const DisplayImage& target,
                                const ColourTransferOptions& options = {});

}  // namespace plenolab
