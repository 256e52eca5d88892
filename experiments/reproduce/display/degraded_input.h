#pragma once

#include <array>

#include "core/reprojection/reprojection.h"

namespace plenolab {

/// Rendered cameras with less than reprojection asks for: claims H-8 and H-9.

/// Clipping planes of coded depth, m; the scenes lie between.
inline constexpr double kCodedNear_m = 0.1, kCodedFar_m = 10;

/// How depth is stored in a texture.
struct DepthCoding {
  enum class Scale {
    kLinear,   ///< 0 at the near plane, 1 at the far one, linear in depth
    kZBuffer,  ///< the same linear in 1/depth, as rasterisers store it
  };
  const char* name;
  Scale scale;
  int bits;  ///< 0 = 32-bit float
};
inline constexpr std::array kDepthCodings{DepthCoding{"8 bits, linear", DepthCoding::Scale::kLinear, 8},
                                          DepthCoding{"8 bits, z-buffer", DepthCoding::Scale::kZBuffer, 8},
                                          DepthCoding{"16 bits, linear", DepthCoding::Scale::kLinear, 16},
                                          DepthCoding{"16 bits, z-buffer", DepthCoding::Scale::kZBuffer, 16},
                                          DepthCoding{"24 bits, z-buffer", DepthCoding::Scale::kZBuffer, 24},
                                          DepthCoding{"float, z-buffer", DepthCoding::Scale::kZBuffer, 0}};

/// A depth (m, clipped to the planes) as it is read back from such a texture.
float coded_depth(float depth_m, const DepthCoding& coding);

/// Colour, and with `depth_too` depth as well, as the mean of 2 × 2 pixels of `fine`, a camera with twice as
/// many across and down as `sharp`. Depth is that of `sharp` otherwise.
RenderedCamera anti_aliased(const RenderedCamera& sharp, const RenderedCamera& fine, bool depth_too);

/// Share of the matched pixels whose disparity is off by more than 5 % from those of the 3 × 3 true pixels
/// around, in the same subimage of `size_px`. 0 without matches. `disparity_px` is negative in holes.
double stray_share(const Plane<float>& disparity_px, const Plane<float>& true_disparity_px, int size_px);

}  // namespace plenolab
