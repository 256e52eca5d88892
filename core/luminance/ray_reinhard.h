#pragma once

#include <cstdint>
#include <optional>

#include "core/luminance/global_luminance.h"

namespace plenolab {

/// The photographic operator without white point for displays (Doronin & Barsi, equations 5 and 6; the curve
/// is reinhard_curve of core/tonemap/reinhard_global.h): L_s = α·L/L̄, L_a = L_s/(1 + L_s), colours times
/// L_a/L. Every ray has the L̄ of its own observer position. Output: linear display light; a saturated colour
/// above 1 is cut to 1.
struct RayReinhardOptions {
  double key = 0.18;  ///< α; (0, 4]
  void validate() const;
};

/// What the operator yields for images of a display or for a picture.
template <class Picture>
struct LightMapped {
  Picture light;
  std::int64_t clipped = 0;    ///< channel values cut to 1
  std::int64_t undefined = 0;  ///< pixels without L̄, left black: nothing in the whole field is above ε
};

/// Input values must be finite and ≥ 0 (core/image/repair.h).
LightMapped<DisplayRays> map_rays(const RayDisplay& display, const SceneRays& rays,
                                  const GlobalLuminance& luminance, const RayReinhardOptions& options = {},
                                  int threads = 0);

/// A picture as a whole with its own ln L̄ (log_average): what the references are made by.
LightMapped<DisplayLightImage> map_picture(const SceneImage& picture, std::optional<double> ln_luminance,
                                           const RayReinhardOptions& options = {}, int threads = 0);

/// Gamma-encoded for looking at and for files.
DisplayImage encoded(const DisplayLightImage& light);

}  // namespace plenolab
