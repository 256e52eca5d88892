#include "experiments/reproduce/claims/geometry_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace plenolab {

namespace {

constexpr std::array kConvex{ShapeKind::kDisc, ShapeKind::kSquare, ShapeKind::kHexagon, ShapeKind::kBar};
constexpr std::array kConcave{ShapeKind::kAngle, ShapeKind::kSlit, ShapeKind::kRing, ShapeKind::kComb};

constexpr double kHalfSide = 0.7071;  ///< of the square in the unit circle

bool in_square(double u, double v) {
  return std::abs(u) <= kHalfSide && std::abs(v) <= kHalfSide;
}

bool in_hexagon(double u, double v) {
  const double c = std::sqrt(0.75);
  return std::abs(v) <= c && std::abs(c * u + 0.5 * v) <= c && std::abs(c * u - 0.5 * v) <= c;
}

/// A square whose right part is cut into teeth by two gaps.
bool in_comb(double u, double v, double gap) {
  const bool in_gap = std::abs(std::abs(v) - kHalfSide / 3) < std::min(gap, 0.2);
  return in_square(u, v) && !(u > -kHalfSide / 2 && in_gap);
}

/// Whether the unit shape covers a point.
bool in_unit_shape(ShapeKind kind, double u, double v, double opening) {
  const double r2 = u * u + v * v;
  switch (kind) {
    case ShapeKind::kDisc:
      return r2 <= 1;
    case ShapeKind::kSquare:
      return in_square(u, v);
    case ShapeKind::kHexagon:
      return in_hexagon(u, v);
    case ShapeKind::kBar:
      return std::abs(u) <= 0.928 && std::abs(v) <= 0.371;  // 5 : 2
    case ShapeKind::kAngle:
      return in_square(u, v) && !(u > -0.2 && v > -0.2);
    case ShapeKind::kSlit:
      return r2 <= 1 && !(u > -0.5 && std::abs(v) < opening);
    case ShapeKind::kRing:
      return r2 <= 1 && r2 >= opening * opening;
    case ShapeKind::kComb:
      return in_comb(u, v, opening);
  }
  return false;
}

}  // namespace

std::span<const ShapeKind> convex_shapes() {
  return kConvex;
}
std::span<const ShapeKind> concave_shapes() {
  return kConcave;
}

const char* name_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::kDisc:
      return "disc";
    case ShapeKind::kSquare:
      return "square";
    case ShapeKind::kHexagon:
      return "hexagon";
    case ShapeKind::kBar:
      return "rectangle";
    case ShapeKind::kAngle:
      return "L";
    case ShapeKind::kSlit:
      return "C with slit";
    case ShapeKind::kRing:
      return "ring";
    case ShapeKind::kComb:
      return "comb";
  }
  return "";
}

std::function<bool(double x, double y)> silhouette(const Shape& shape) {
  return [shape, c = std::cos(shape.angle), s = std::sin(shape.angle)](double x, double y) {
    const double dx = (x - shape.x) / shape.radius_px, dy = (y - shape.y) / shape.radius_px;
    if (dx * dx + dy * dy > 1) return false;
    return in_unit_shape(shape.kind, c * dx + s * dy, c * dy - s * dx, shape.opening);
  };
}

double reach(const Shape& shape, double direction) {
  constexpr int kCells = 100;
  const auto covers = silhouette(shape);
  const double towards_x = std::cos(direction), towards_y = std::sin(direction);
  double far = 0;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) {
      const double dx = (2.0 * i / kCells - 1) * shape.radius_px,
                   dy = (2.0 * j / kCells - 1) * shape.radius_px;
      if (covers(shape.x + dx, shape.y + dy)) far = std::max(far, dx * towards_x + dy * towards_y);
    }
  return far;
}

double uniform(RandomStream& random, double low, double high) {
  return low + (high - low) * random.next_double();
}

Shape random_shape(ShapeKind kind, double radius_low, double radius_high, RandomStream& random) {
  Shape shape;
  shape.kind = kind;
  shape.radius_px = uniform(random, radius_low, radius_high);
  shape.angle = uniform(random, 0, 2 * std::numbers::pi);
  shape.opening = uniform(random, 0.12, 0.35);
  return shape;
}

}  // namespace plenolab
