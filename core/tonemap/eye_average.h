#pragma once

#include "core/image/image.h"

namespace plenolab {

/// Arithmetic mean luminance of a view without specks, in the unit of the view: every pixel counts with its
/// luminance, but at most with the third largest among itself and its eight neighbours (fewer at the border).
///
/// It stands for the light that reaches the eye, which a light source decides however small it is in the
/// view: a sun disc of a few pixels raises it by decades. One or two pixels of any size, as glints and noise
/// of path tracing make them, count like their surroundings. NaN, Inf and negative values count as
/// core/image/repair.h replaces them. 0 for a black view or one without pixels. Bit-identical for any number
/// of threads.
double eye_average(const SceneImage& view, int threads = 0);

}  // namespace plenolab
