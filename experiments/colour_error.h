#pragma once

#include "core/image/cielab.h"

namespace plenolab {

/// How far the colours of a picture are from those of another, in ΔE*ab of CIE 1976 (core/image/cielab.h).
struct ColourError {
  double mean = 0, largest = 0;
};

/// The colours of a picture.
Plane<CieLab> lab_of(const DisplayImage& picture, int threads = 0);

/// Pixel by pixel. Pictures must have equal sizes and at least one pixel.
ColourError colour_error(const Plane<CieLab>& test, const Plane<CieLab>& reference);
ColourError colour_error(const DisplayImage& test, const DisplayImage& reference, int threads = 0);

}  // namespace plenolab
