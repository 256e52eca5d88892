#pragma once

#include <functional>
#include <span>

#include "core/base/random.h"

namespace plenolab {

/// Silhouettes of flat occluders. The first four are convex: no point of negative curvature. The others have
/// what section 4.1.5 of the thesis calls prone to rendering failures: a concave corner, a slit, a hole,
/// gaps.
enum class ShapeKind { kDisc, kSquare, kHexagon, kBar, kAngle, kSlit, kRing, kComb };

std::span<const ShapeKind> convex_shapes();
std::span<const ShapeKind> concave_shapes();
/// "disc", "square", …
const char* name_of(ShapeKind kind);

/// A silhouette in image coordinates.
struct Shape {
  ShapeKind kind = ShapeKind::kDisc;
  double x = 0, y = 0;    ///< centre
  double radius_px = 10;  ///< of the circumscribed circle
  double angle = 0;       ///< turned by, radians
  double opening =
      0.2;  ///< half the width of slit and gaps, and the radius of the hole, as share of the radius
};

/// Whether the shape covers a point.
std::function<bool(double x, double y)> silhouette(const Shape& shape);

/// How far the shape reaches from its centre in a direction (radians): its support function, to 2 % of the
/// radius.
double reach(const Shape& shape, double direction);

/// Uniform in [low, high).
double uniform(RandomStream& random, double low, double high);

/// A shape at the origin with radius in the given range, any angle, and openings of 0.12 to 0.35 radii.
Shape random_shape(ShapeKind kind, double radius_low_px, double radius_high_px, RandomStream& random);

}  // namespace plenolab
