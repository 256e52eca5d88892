#pragma once

#include <string>
#include <vector>

#include "core/lightfield/light_field.h"
#include "stimuli/scene.h"

namespace plenolab {

/// Probe scenes of the claims on appearance, and where in the image their parts lie.

/// What the floor of `floor_probe` is made of. All floors reflect the same share of light on average.
struct FloorLook {
  enum class Kind { kMirror, kMetal, kDiffuse };
  Kind kind = Kind::kMirror;
  double roughness = 0.1;   ///< GGX α of kMetal
  double ripple_slope = 0;  ///< root mean square slope of ripples in each direction, 0 = flat
};

/// "mirror", "α = 0.1", "diffuse", "rippled mirror".
std::string name_of(const FloorLook& look);

/// A small round lamp above the floor. `reflection_m` is its mirror image below an ideally flat floor.
struct FloorLamp {
  Vec3 position_m, reflection_m;
};

/// A camera that looks down at a floor and sees nothing but the floor. Above it, outside every image, hang
/// round lamps of 1500 cd/m² in three rows and a bright window, under a sky of 100 cd/m². So there are no
/// depth edges and no occlusion: whatever differs between a synthesised view and the truth is a matter of
/// appearance.
Scene floor_probe(const FloorLook& look);
std::vector<FloorLamp> floor_lamps();
/// Scale that makes the lamps' mirror image white.
inline constexpr float kFloorExposure = 1.0f / 900;

/// Sunlit dust in a box before a dim wall 8 m away, beside a post or alone.
struct DustLook {
  Vec3 centre_m{0, 2.5f, 0}, size_m{0.09f, 0.09f, 0.09f};
  float scattering_per_m = 0;  ///< 0 = clear air
  bool post = false;           ///< a post 3 m away, its right edge 0.1 m left of the image centre
};
Scene dust_probe(const DustLook& look);
inline constexpr float kDustExposure = 1.0f / 250;
inline constexpr double kDustWallDepth_m = 8;

/// Image coordinates (pixel centres at integer + 0.5) of a point seen from a position on the camera grid.
struct ImagePoint {
  double x = 0, y = 0;
  double disparity_px = 0;
};
ImagePoint project(const GridCamera& camera, const ViewGrid& grid, CameraPosition position,
                   const Vec3& point_m);

}  // namespace plenolab
