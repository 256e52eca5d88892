#pragma once

#include "core/luminance/ray_images.h"

namespace plenolab {

/// What an observer of a display sees: the pinhole image of a position (Doronin & Barsi, sections 3 and 4.2).
template <class Referral>
struct Perceived {
  RgbImage<Referral> image;
  /// Pixels that no ray lights for this observer, black in the image: places that the display does not reach.
  std::int64_t unlit = 0;
};

/// Each pixel is the mean of the rays that light the middle of the pixel on the screen, weighted by what
/// reaches the observer: Σ w L / Σ w. Without the division the picture ripples, by 12 % with the projector
/// display's diffuser. The display's own resolution() loses nothing; the observer may stand anywhere.
Perceived<SceneReferred> perceive(const RayDisplay& display, const SceneRays& rays, ObserverPosition observer,
                                  PinholeSize size, int threads = 0);
Perceived<DisplayLight> perceive(const RayDisplay& display, const DisplayRays& rays,
                                 ObserverPosition observer, PinholeSize size, int threads = 0);

/// The same, pixel by pixel in double precision for any display: the reference of the tests.
Perceived<SceneReferred> perceive_literally(const RayDisplay& display, const SceneRays& rays,
                                            ObserverPosition observer, PinholeSize size);

}  // namespace plenolab
