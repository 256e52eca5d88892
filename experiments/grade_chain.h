#pragma once

#include <functional>

#include "core/image/image.h"

namespace plenolab {

/// A chain of colour correction as games compute it for every pixel, smooth, from encoded values in [0, 1] to
/// encoded values in [0, 1]: white balance and exposure in linear light, contrast about middle grey,
/// saturation, lift, gamma and gain, and the curve of Gran Turismo (Uchimura 2017, "HDR theory and practice",
/// with its printed parameters), which Zhao 2019 (section 4.1) names as costly. What a look-up table replaces
/// where error against run time is asked for.
Rgb grade_chain(Rgb encoded);

/// A chain evaluated for every pixel of a picture; pure, as many threads call it.
DisplayImage evaluate_chain(const DisplayImage& picture, const std::function<Rgb(Rgb)>& chain, int threads);

/// The curve alone: display light of linear light ≥ 0.
float gran_turismo_curve(float x);

}  // namespace plenolab
