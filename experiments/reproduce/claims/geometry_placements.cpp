#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

namespace {

// Sizes and disparities of the placements, in pixels. Radii exceed the largest displacement against the
// background.
constexpr double kRadiusLow = 14, kRadiusHigh = 20;
constexpr double kDisparityLow = 8, kDisparityHigh = 14;
constexpr double kBackgroundHigh = 3;
constexpr double kBeamRadius = 80;

}  // namespace

ViewGrid occluder_grid() {
  return probe_grid(2, 2, 0.1, kOccluderWidth, kOccluderHeight);
}

OccluderPlacement place_inside(ShapeKind kind, RandomStream& random) {
  OccluderPlacement placement;
  Shape shape = random_shape(kind, kRadiusLow, kRadiusHigh, random);
  const double disparity = uniform(random, kDisparityLow, kDisparityHigh);
  placement.background_px = uniform(random, 0, kBackgroundHigh);
  // Between the middle of the cell and a key view the occluder moves by half its disparity; what it hides
  // from one key view is up to a background disparity away in another.
  const double margin = shape.radius_px + disparity / 2 + placement.background_px;
  shape.x = uniform(random, margin, kOccluderWidth - margin);
  shape.y = uniform(random, margin, kOccluderHeight - margin);
  placement.shapes = {shape};
  placement.disparities_px = {disparity};
  return placement;
}

OccluderPlacement place_pair(ShapeKind kind, RandomStream& random) {
  OccluderPlacement placement;
  // Not larger, so that two of them stay in all four frustums.
  Shape a = random_shape(kind, kRadiusLow, 16, random), b = random_shape(kind, kRadiusLow, 16, random);
  // Side by side along a row: the image is wider than high. Where they stand one above the other, the same
  // happens.
  const double direction = uniform(random, -0.3, 0.3);
  const double gap = uniform(random, 2, 6);
  const double distance = reach(a, direction) + gap + reach(b, direction + std::numbers::pi);
  const double dx = distance / 2 * std::cos(direction), dy = distance / 2 * std::sin(direction);
  a.x = kOccluderWidth / 2.0 - dx, a.y = kOccluderHeight / 2.0 - dy;
  b.x = kOccluderWidth / 2.0 + dx, b.y = kOccluderHeight / 2.0 + dy;
  placement.shapes = {a, b};
  placement.disparities_px = {uniform(random, kDisparityLow, kDisparityHigh),
                              uniform(random, kDisparityLow, kDisparityHigh)};
  placement.background_px = uniform(random, 0, kBackgroundHigh);
  return placement;
}

OccluderPlacement place_at_border(ShapeKind kind, RandomStream& random) {
  OccluderPlacement placement;
  const double disparity = uniform(random, kDisparityLow, kDisparityHigh);
  placement.background_px = uniform(random, 3, 6);
  // Directions into the image from the left, right, upper and lower border.
  const auto border = static_cast<int>(random.next_u64() % 4);
  const bool upright = border < 2, low = border % 2 == 0;
  const double inwards = (upright ? 0 : std::numbers::pi / 2) + (low ? 0 : std::numbers::pi);
  Shape shape = random_shape(kind, kRadiusLow, kRadiusHigh, random);
  if (kind == ShapeKind::kBar) {
    // A beam along the border, longer than the image.
    shape.radius_px = kBeamRadius;
    shape.angle = inwards + std::numbers::pi / 2 + uniform(random, -0.1, 0.1);
  }
  // How far it reaches into the image, as the middle of the cell sees it: half a disparity more as the key
  // views on this side see it, half a disparity less, that is not at all, as the others do.
  const double edge = uniform(random, -0.5, 0.5) * disparity;
  const double centre = edge - reach(shape, inwards);
  const double along = uniform(random, 0.3, 0.7);
  const double size = upright ? kOccluderWidth : kOccluderHeight;
  const double across = low ? centre : size - centre;
  shape.x = upright ? across : along * kOccluderWidth;
  shape.y = upright ? along * kOccluderHeight : across;
  placement.shapes = {shape};
  placement.disparities_px = {disparity};
  return placement;
}

FlatWorld world_of(const OccluderPlacement& placement, Patterned patterned) {
  FlatWorld world;
  for (std::size_t i = 0; i < placement.shapes.size(); ++i) {
    FlatSurface& surface = world.surfaces.emplace_back();
    surface.disparity_px = placement.disparities_px[i];
    const Shape& shape = placement.shapes[i];
    surface.covers = silhouette(shape);
    surface.bounds = {shape.x - shape.radius_px, shape.x + shape.radius_px, shape.y - shape.radius_px,
                      shape.y + shape.radius_px};
    if (patterned == Patterned::kNothing)
      surface.colour = Rgb{0.8f, 0.8f, 0.8f};
    else
      surface.colour = [pattern = flat_pattern(5, static_cast<std::uint32_t>(i + 1))](double x, double y) {
        return pattern(x, y) * Rgb{1, 0.55f, 0.2f};
      };
  }
  FlatSurface& background = world.surfaces.emplace_back();
  background.disparity_px = placement.background_px;
  if (patterned == Patterned::kEverything)
    background.colour = flat_pattern(4, 11);
  else
    background.colour = Rgb{0.2f, 0.2f, 0.2f};
  return world;
}

}  // namespace plenolab
