#include "experiments/reproduce/tonemap/suitability_measures.h"

#include <fmt/format.h>

#include <utility>

namespace plenolab {

namespace {

/// Share that "the contrast within" a part leaves out at each end.
constexpr double kWithinTail = 0.1;
/// The same for the range of luma that a view uses.
constexpr double kUsedTail = 0.01;
/// Floor and water lie at height 0 in the scenes' own coordinates.
constexpr double kGround_m = 0.05;
/// Underside of the cellars' joists, which hang below boards at 2.45 m.
constexpr double kCeilingFrom_m = 2.2, kCeilingTo_m = 2.6;
constexpr double kFarWater_m = 100;
constexpr double kSunlitPart = 0.25;
constexpr double kBrightPart = 0.1;

}  // namespace

IndoorsOutdoors indoors_and_outdoors(const SectionView& view) {
  Mask outdoors = deeper_than(view, kBehindTheWall_m);
  Mask indoors = without(whole(view.depth_m), outdoors);
  return {region_of(view, std::move(indoors), kWithinTail),
          region_of(view, std::move(outdoors), kWithinTail)};
}

IndoorsOutdoorsNumbers measure(const SectionView& view, const IndoorsOutdoors& parts,
                               const Plane<float>& luma) {
  const ToneSpread indoors = spread_in(luma, parts.indoors.mask, kWithinTail);
  const ToneSpread outdoors = spread_in(luma, parts.outdoors.mask, kWithinTail);
  return {indoors.middle, outdoors.middle,
          relative_contrast(outdoors.middle - indoors.middle, parts.log_between(), view),
          contrast_within(view, parts.indoors, indoors), contrast_within(view, parts.outdoors, outdoors)};
}

ViewAndWater view_and_water(const SectionView& view) {
  return {region_of(view, whole(view.depth_m), kUsedTail),
          region_of(view, at_heights(view, -kGround_m, kGround_m, kFarWater_m), kUsedTail)};
}

UsedRange measure(const SectionView& view, const ViewAndWater& parts, const Plane<float>& luma) {
  const ToneSpread water = spread_in(luma, parts.water.mask, kUsedTail);
  return {spread_in(luma, parts.all.mask, kUsedTail), water, contrast_within(view, parts.water, water)};
}

ShadeAndGlare shade_and_glare(const SectionView& view) {
  const Mask outdoors = deeper_than(view, kBehindTheWall_m);
  const Mask floor = at_heights(view, -kGround_m, kGround_m, kBehindTheWall_m);
  const Mask ceiling = at_heights(view, kCeilingFrom_m, kCeilingTo_m, kBehindTheWall_m);
  const Mask indoors = without(whole(view.depth_m), outdoors);
  Mask glare = without(indoors, darker_part(view, indoors, 1 - kBrightPart));
  const Mask surfaces = without(both(floor, ceiling), glare);
  return {region_of(view, darker_part(view, surfaces, 1 - kSunlitPart), kWithinTail),
          region_of(view, std::move(glare), kWithinTail)};
}

ShadeAndGlareNumbers measure(const SectionView& view, const ShadeAndGlare& parts, const Plane<float>& luma) {
  const ToneSpread shade = spread_in(luma, parts.shade.mask, kWithinTail);
  const ToneSpread glare = spread_in(luma, parts.glare.mask, kWithinTail);
  return {shade.middle, glare.middle, contrast_within(view, parts.shade, shade),
          contrast_within(view, parts.glare, glare)};
}

std::vector<double> brightness_parameters() {
  return {-8, -6, -5, -4, -3, -2, -1, 0, 2, 4, 6, 8};
}

SectionOperator reinhard_with_brightness(double b) {
  return section_operator(fmt::format("Reinhard 2005, b = {:g}", b), "reinhard05", "naive",
                          {fmt::format("b={:g}", b)});
}

}  // namespace plenolab
