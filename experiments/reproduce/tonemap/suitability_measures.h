#pragma once

#include "experiments/reproduce/tonemap/suitability.h"

namespace plenolab {

/// What figures 45 to 47 and claim A-T11 measure of a tone mapped key view. Contrasts are relative_contrast:
/// 1 is that of a straight line in log luminance over the view's range.

/// The cellar, figure 45.
struct IndoorsOutdoors {
  ToneRegion indoors;
  ToneRegion outdoors;  ///< deeper than the far wall: what window and hatch show
  double log_between() const { return outdoors.log_luminance.middle - indoors.log_luminance.middle; }
};
/// The far wall of both cellars stands 7.4 m from the cameras.
inline constexpr double kBehindTheWall_m = 8;
IndoorsOutdoors indoors_and_outdoors(const SectionView& view);

struct IndoorsOutdoorsNumbers {
  double luma_indoors = 0, luma_outdoors = 0;  ///< medians
  double between = 0;                          ///< contrast of the medians
  double within_indoors = 0, within_outdoors = 0;
};
IndoorsOutdoorsNumbers measure(const SectionView& view, const IndoorsOutdoors& parts,
                               const Plane<float>& luma);

/// Boats and Lanterns, figure 46: the whole view and the surface of the water up to 100 m away.
struct ViewAndWater {
  ToneRegion all, water;
};
ViewAndWater view_and_water(const SectionView& view);

struct UsedRange {
  ToneSpread all, water;    ///< luma, first percentile to 99th
  double within_water = 0;  ///< contrast of these percentiles of the water
};
UsedRange measure(const SectionView& view, const ViewAndWater& parts, const Plane<float>& luma);

/// The cellar with light shafts, figure 47.
struct ShadeAndGlare {
  ToneRegion shade;  ///< floor and ceiling without the brightest quarter of them, which direct sun hits
  /// The brightest tenth of what lies indoors: sunlit patches, lamps and shafts. (Taken first were surfaces
  /// around the openings; most of them turned out to lie in the shade.)
  ToneRegion glare;
};
ShadeAndGlare shade_and_glare(const SectionView& view);

struct ShadeAndGlareNumbers {
  double luma_shade = 0, luma_glare = 0;      ///< medians
  double within_shade = 0, within_glare = 0;  ///< contrast of the 10th to 90th percentile
  double worse() const { return within_shade < within_glare ? within_shade : within_glare; }
};
ShadeAndGlareNumbers measure(const SectionView& view, const ShadeAndGlare& parts, const Plane<float>& luma);

/// Brightness parameters b of Reinhard & Devlin 2005 that figure 47 tries, over all that the operator takes.
/// A factor on the radiance acts like a shift of b, so they cover any unit.
std::vector<double> brightness_parameters();
SectionOperator reinhard_with_brightness(double b);

}  // namespace plenolab
