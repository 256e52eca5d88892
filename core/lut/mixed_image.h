#pragma once

#include <span>

#include "core/image/image.h"
#include "core/lut/grade.h"

namespace plenolab {

/// Mixed images (Zhao 2019, section 4.5): every part of a picture graded by the table of its own volume,
/// instead of the whole picture by a blend. The reference that blends are judged against, and dear.

/// The volume of each pixel's object: the one that holds most of the object's pixels in this picture (the
/// background, −1, counts as one; of equal ones the first, the background before all). `volume` as
/// volume_of_pixels gives it, all < `volumes`; `object` any numbers ≥ 0 of the same size, negative where
/// nothing is, which stays the pixel's own volume. Throws InputError for maps of different sizes.
Plane<int> volume_of_objects(const Plane<int>& volume, const Plane<int>& object, int volumes);

/// Each pixel graded by the table of its volume (−1: the background's), whatever the volumes' weights, cut to
/// [0, 1]. Throws InputError for different sizes.
DisplayImage grade_mixed(const DisplayImage& image, const Plane<int>& volume,
                         std::span<const PreparedLut> tables, const PreparedLut& background, int threads = 0);

}  // namespace plenolab
