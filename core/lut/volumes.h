#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/lut/lut.h"

namespace plenolab {

/// Post-processing volumes: boxes of a scene inside which colours are graded by a table of their own. How
/// several are blended into one table for a frame: from the place of the camera (linear, what game engines
/// do) or from what the camera sees (pixel-based; Zhao 2019, section 4.3, algorithm 1).

/// World coordinates or directions, metres.
using Point3 = std::array<double, 3>;

/// An axis-aligned closed box. One without extent holds the points of a plane, a line or one point.
struct Volume {
  std::string name;
  Point3 min{}, max{};        ///< metres, min ≤ max, finite
  double blend_radius_m = 0;  ///< ≥ 0: how far outside the linear method still feels it
  double weight = 1;          ///< in [0, 1]: share of the frame it takes at most

  /// Throws InputError that names the volume and what is wrong.
  void validate() const;
  bool contains(const Point3& point) const;
  /// Distance to the box, 0 inside.
  double distance_m(const Point3& point) const;
};

/// Index of the smallest volume that holds the point, −1 if none does: "if multiple overlap, the most
/// internal". Smallest by content, then by diagonal, then the first.
int innermost(std::span<const Volume> volumes, const Point3& point);
/// Indices in that order of precedence.
std::vector<int> innermost_first(std::span<const Volume> volumes);

/// Shares of the volumes' tables and of the background's in the blend of a frame; sum to 1.
struct VolumeWeights {
  std::vector<double> volumes;
  double background = 1;
};

/// Linear: weight·max(0, 1 − d/r) by the distance d of the camera to each box; inside a box the innermost
/// has its weight alone. Weights of more than 1 together are divided by their sum; the background takes the
/// rest. Throws InputError for volumes out of range or a position that is not finite.
VolumeWeights linear_weights(std::span<const Volume> volumes, const Point3& camera_m);

/// A pinhole camera with the principal point in the image centre and square pixels.
struct DepthCamera {
  Point3 position_m{};
  Point3 forward{0, 1, 0}, up{0, 0, 1};  ///< unit, orthogonal; the image's right is forward × up
  double fov_h_deg = 60;                 ///< full horizontal opening angle, in (0, 180)

  /// Throws InputError with the value out of range.
  void validate() const;
  /// World position of the surface at planar depth `depth_m` at the centre of pixel (x, y) of a width ×
  /// height image: position + depth·ray, the ray's component along `forward` being 1.
  Point3 world_of(int x, int y, int width, int height, double depth_m) const;
};

struct CountOptions {
  int stride = 1;   ///< every stride-th pixel of every stride-th row, from the first: point sampling, ≥ 1
  int threads = 0;  ///< 0 = all cores
};

struct VolumeCounts {
  std::vector<std::int64_t> volumes;  ///< pixels whose innermost volume it is
  std::int64_t background = 0;        ///< in no volume, at infinity, or of no valid depth (NaN, ≤ 0)
  std::int64_t pixels() const;
};

/// Counts pixels of a map of planar depth (metres, ∞ where nothing is) by the volume in which their surface
/// lies. 32-bit arithmetic from the camera's position on, vectorised: surfaces within rounding of a face may
/// fall to either side, wherever in the world the scene lies. Throws InputError for volumes, camera or
/// options out of range.
VolumeCounts count_pixels(const Plane<float>& depth_m, const DepthCamera& camera,
                          std::span<const Volume> volumes, const CountOptions& options = {});

/// The volume of each pixel, −1 for the background, as count_pixels sees it.
Plane<int> map_pixels(const Plane<float>& depth_m, const DepthCamera& camera, std::span<const Volume> volumes,
                      int threads = 0);

/// The volume of each pixel, −1 for the background: the literal algorithm in 64 bits, one by one.
Plane<int> volume_of_pixels(const Plane<float>& depth_m, const DepthCamera& camera,
                            std::span<const Volume> volumes, int threads = 0);

/// Pixel-based: share of the pixels times the volume's weight; the background takes the rest.
VolumeWeights pixel_weights(const VolumeCounts& counts, std::span<const Volume> volumes);

/// The table of a frame. `tables` has one for each volume. Throws InputError as blend_luts does.
Lut blend_volumes(const VolumeWeights& weights, std::span<const Lut> tables, const Lut& background);

}  // namespace plenolab
