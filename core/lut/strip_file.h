#pragma once

#include "core/lut/lut.h"

namespace plenolab {

/// Look-up tables as images, as game engines exchange them: size tiles of size × size pixels side by side;
/// red rises to the right within a tile, green downwards, blue from tile to tile. The domain is 0 … 1.

/// Throws InputError if the image is not size² × size pixels with a size of 2 … 256.
Lut lut_of_strip(const DisplayImage& strip, const std::string& name);

/// Outputs that leave [0, 1] by no more than rounding does (1e-4) are cut. Throws InputError for a domain
/// other than 0 … 1 or outputs farther out, which an image cannot hold.
DisplayImage strip_of_lut(const Lut& lut);

}  // namespace plenolab
