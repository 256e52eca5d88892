#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "stimuli/tracer/maths.h"

namespace plenolab::tracer {

/// A point drawn on a light source.
struct EmitterPoint {
  Vec3 position_m;
  Vec3 normal;         ///< unit, of the triangle
  float pdf_area = 0;  ///< per square metre
  const Material* material = nullptr;
};

/// Radiance an emitter sends from a point with `normal` into `direction`.
Rgb emitted(const Material& material, const Vec3& normal, const Vec3& direction);

/// The luminous triangles of a scene, drawn in proportion to their luminous flux and uniformly over their
/// area.
class Emitters {
 public:
  /// The scene must outlive it. Triangles without area or radiance are left out.
  explicit Emitters(const Scene& scene);

  bool empty() const { return triangles_.empty(); }
  /// Empty only without emitters.
  std::optional<EmitterPoint> sample(float select, std::array<float, 2> u) const;
  /// Density per square metre with which sample() finds a point on a triangle of this material.
  float pdf_area(const Material& material) const;

 private:
  struct Triangle {
    Vec3 corner, edge_1, edge_2, normal;
    const Material* material;
  };
  std::vector<Triangle> triangles_;
  std::vector<double> cumulative_;    ///< normalised, one entry a triangle
  std::vector<std::uint32_t> guide_;  ///< first triangle of each of equal shares of cumulative_, and the end
  double total_weight_ = 0;           ///< Σ luminance · sides · area
};

}  // namespace plenolab::tracer
