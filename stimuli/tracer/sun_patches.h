#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stimuli/tracer/ray_scene.h"
#include "stimuli/tracer/sun_light.h"

namespace plenolab::tracer {

/// A sunlit point inside, found by following the sun through an opening.
struct SunPatchPoint {
  Hit hit;             ///< the surface the sun shines on, as seen from the opening
  Vec3 sun_direction;  ///< unit, towards the sun
  float pdf_area = 0;  ///< per square metre of that surface, for this direction of the sun
};

/// The patches of sunlight an interior gets through its portals. Walls are lit by them more than by anything
/// else, but a direction drawn by the BSDF rarely meets one: they are small. So points on them are drawn
/// directly: a point of an opening, a direction inside the sun's disc, the first surface behind. The density
/// is known for any sunlit point, which lets both ways be combined.
///
/// The openings are cut into cells; how often each one lets the sun through is probed once, and cells are
/// drawn in proportion to it, those that never did with a small share, so that no light is lost.
class SunPatches {
 public:
  /// The scene must outlive it.
  SunPatches(const Scene& scene, const RayScene& rays, const SunLight& sun);

  /// Whether no probe of any opening got through: then nothing can be drawn and pdf_area() is 0.
  bool empty() const { return cells_.empty(); }
  /// Empty if the drawn ray is blocked or meets nothing. Traces two rays.
  std::optional<SunPatchPoint> sample(float select, std::array<float, 2> on_opening,
                                      std::array<float, 2> on_disc) const;
  /// Density with which sample() finds a point with this unit normal for this direction of the sun, if the
  /// sun shines on it.
  float pdf_area(const Vec3& position_m, const Vec3& normal, const Vec3& sun_direction) const;

 private:
  struct Opening {
    Vec3 corner, edge_u, edge_v, normal;
    Vec3 dual_u, dual_v;  ///< (p − corner)·dual gives the coordinates in the parallelogram
    float area = 0;
    int cells_u = 1, cells_v = 1;
    std::size_t first_cell = 0;
  };
  struct Cell {
    std::size_t opening = 0;
    int u = 0, v = 0;
    float density_per_m2 = 0;  ///< of points of the opening
  };
  void add_cells(const SkyPortal& portal);
  Vec3 point_in(const Cell& cell, std::array<float, 2> u) const;
  double share_let_through(const Cell& cell) const;
  bool follow(const Vec3& from, const Vec3& sun_direction, Hit& hit) const;

  const RayScene& rays_;
  const SunLight& sun_;
  std::vector<Opening> openings_;
  std::vector<Cell> cells_;
  std::vector<float> cumulative_;
};

}  // namespace plenolab::tracer
