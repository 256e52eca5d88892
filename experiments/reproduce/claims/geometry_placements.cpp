#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

namespace {

// Sizes and disparities of the placements, in pixels: occluders much larger than a pixel, displaced between
// neighbouring key views by about their own size, as near objects of the scenes are.
constexpr double kRadiusLow = 8, kRadiusHigh = 14;
constexpr double kDisparityLow = 8, kDisparityHigh = 18;
constexpr double kBackgroundHigh = 3;

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
  // Smaller than single ones, so that two of them stay in all four frustums.
  Shape a = random_shape(kind, 7, 10, random), b = random_shape(kind, 7, 10, random);
  const double direction = uniform(random, 0, 2 * std::numbers::pi);
  const double gap = uniform(random, 2, 8);
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
  Shape shape = random_shape(kind, kRadiusLow, kRadiusHigh, random);
  const double disparity = uniform(random, kDisparityLow, kDisparityHigh);
  placement.background_px = uniform(random, 2, 6);
  // Where the centre lies behind the border as a key view on that side sees it: the border cuts the shape.
  const double behind = uniform(random, -0.8, 0.8) * shape.radius_px;
  const double side = random.next_double() < 0.5 ? -1 : 1;
  const double inwards = side * disparity / 2 - behind;
  const std::uint64_t border = random.next_u64() % 4;
  const double along = uniform(random, 0.3, 0.7);
  const bool upright = border < 2;
  shape.x = upright ? (border == 0 ? inwards : kOccluderWidth - inwards) : along * kOccluderWidth;
  shape.y = upright ? along * kOccluderHeight : (border == 2 ? inwards : kOccluderHeight - inwards);
  placement.shapes = {shape};
  placement.disparities_px = {disparity};
  return placement;
}

FlatWorld world_of(const OccluderPlacement& placement, bool textured) {
  FlatWorld world;
  const auto plain = [](float v) { return [v](double, double) { return Rgb{v, v, v}; }; };
  for (std::size_t i = 0; i < placement.shapes.size(); ++i) {
    FlatSurface& surface = world.surfaces.emplace_back();
    surface.disparity_px = placement.disparities_px[i];
    surface.covers = [shape = placement.shapes[i]](double x, double y) { return shape.covers(x, y); };
    const auto pattern = flat_pattern(5, static_cast<std::uint32_t>(i + 1));
    if (textured)
      surface.colour = [pattern](double x, double y) { return pattern(x, y) * Rgb{1, 0.55f, 0.2f}; };
    else
      surface.colour = plain(0.8f);
  }
  FlatSurface& background = world.surfaces.emplace_back();
  background.disparity_px = placement.background_px;
  if (textured)
    background.colour = flat_pattern(4, 11);
  else
    background.colour = plain(0.2f);
  return world;
}

}  // namespace plenolab
