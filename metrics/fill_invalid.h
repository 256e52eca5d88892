#pragma once

#include "core/image/image.h"

namespace plenolab {

/// The plane with the mean of its valid pixels in place of the others, for metrics whose filters reach beyond
/// the mask: what invalid pixels hold does not matter. A null mask changes nothing; at least one valid pixel.
Plane<float> fill_invalid(Plane<float> plane, const Mask* valid);

}  // namespace plenolab
