#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/reproduce/tonemap/suitability_measures.h"

namespace plenolab {
namespace {

/// 100 × 2 px: log luminance rises from 0 to 4 along x; the lower row shows the floor, the upper one what is
/// 1 m above it. The last ten columns are infinitely far.
SectionView ramp_view() {
  SectionView view;
  view.log_luminance = Plane<float>(100, 2);
  view.depth_m = Plane<float>(100, 2, 5.0f);
  view.height_m = Plane<float>(100, 2);
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 2; ++y) {
      view.log_luminance.at(x, y) = static_cast<float>(x) * 0.04f;
      view.height_m.at(x, y) = y == 0 ? 1.0f : 0.0f;
      if (x >= 90) view.depth_m.at(x, y) = std::numeric_limits<float>::infinity();
    }
  view.log_p1 = 0.5;
  view.log_p99 = 3;
  return view;
}

/// Luma on a straight line in log luminance from the first to the 99th percentile, times `slope`.
Plane<float> straight_luma(const SectionView& view, double slope) {
  Plane<float> luma = view.log_luminance;
  for (float& v : luma.pixels())
    v = static_cast<float>(slope * (static_cast<double>(v) - view.log_p1) / view.log_range());
  return luma;
}

std::size_t pixels_of(const Mask& mask) {
  return static_cast<std::size_t>(std::count(mask.pixels().begin(), mask.pixels().end(), 1));
}

TEST(Suitability, AStraightLineKeepsEveryContrastAndHalfItsSlopeHalf) {
  const SectionView view = ramp_view();
  const IndoorsOutdoors parts = indoors_and_outdoors(view);
  for (const double slope : {1.0, 0.5}) {
    const IndoorsOutdoorsNumbers n = measure(view, parts, straight_luma(view, slope));
    EXPECT_NEAR(n.between, slope, 1e-5);
    EXPECT_NEAR(n.within_indoors, slope, 1e-5);
    EXPECT_NEAR(n.within_outdoors, slope, 1e-5);
    const ShadeAndGlare shade = shade_and_glare(view);
    EXPECT_NEAR(measure(view, shade, straight_luma(view, slope)).worse(), slope, 1e-5);
  }
}

TEST(Suitability, PartsAreToldByDepthHeightAndLuminance) {
  const SectionView view = ramp_view();
  const IndoorsOutdoors parts = indoors_and_outdoors(view);
  EXPECT_EQ(pixels_of(parts.outdoors.mask), 20u);
  EXPECT_EQ(pixels_of(parts.indoors.mask), 180u);
  EXPECT_EQ(pixels_of(at_heights(view, -0.1, 0.1, 8)), 90u);
  const Mask floor = at_heights(view, -0.1, 0.1, 8), dark = darker_part(view, floor, 0.5);
  EXPECT_EQ(pixels_of(dark), 45u);
  EXPECT_EQ(dark.at(10, 1), 1);
  EXPECT_EQ(dark.at(80, 1), 0);
  EXPECT_EQ(pixels_of(without(floor, dark)), 45u);
  EXPECT_EQ(pixels_of(both(dark, parts.outdoors.mask)), 65u);
}

TEST(Suitability, AFlatMappingKeepsNothingAndAFlatSceneHasNoContrastToKeep) {
  SectionView view = ramp_view();
  const Plane<float> grey(100, 2, 0.5f);
  EXPECT_EQ(measure(view, indoors_and_outdoors(view), grey).between, 0);
  EXPECT_EQ(measure(view, view_and_water(view), grey).all.range(), 0);
  view.log_luminance = Plane<float>(100, 2, 1.0f);
  EXPECT_EQ(measure(view, indoors_and_outdoors(view), grey).between, 0);
}

TEST(Suitability, AnEmptyPartHasASpreadOfZero) {
  const ToneSpread none = spread_in(Plane<float>(4, 4, 3.0f), Mask(4, 4), 0.1);
  EXPECT_EQ(none.low, 0);
  EXPECT_EQ(none.range(), 0);
}

}  // namespace
}  // namespace plenolab
