#pragma once

#include <string>
#include <vector>

#include "experiments/reproduce/tonemap/mapping_bench.h"

namespace plenolab {

/// The ways to show a scene that figures and claims on consistency compare. Settings are the operators'
/// defaults but for these, which follow from the key views of the whole light field:
///  - Reinhard & Devlin's formula depends on the unit of the radiance. The thesis' scenes are in relative
///    units; here radiance is scaled by one factor for all views that makes the log average 1.
///  - Limits set by hand (joint variant, section 5.1.6) are the medians of the limits that the naive variant
///    finds in the key views.
enum class Shown {
  kBilateralNaive,
  kBilateralEnhanced,
  kHistogram,
  kHistogramFixed,      ///< four trimming passes (section 6.2.2)
  kReinhardNaive,       ///< every key view by itself
  kReinhardJoint,       ///< limits set by hand
  kReinhardJointAuto,   ///< limits over all key views
  kReinhardAdjusted,    ///< naive, then key-view adjustment
  kReinhardResults,     ///< frames; results of the key views' mappings interpolated
  kReinhardStatistics,  ///< frames; statistics interpolated, adapted in time
  kRobust,              ///< frames; robust statistics interpolated, adapted in time
};

Mapping mapping_for(MappingBench& bench, const std::string& scene, Shown shown);
std::vector<Mapping> mappings_for(MappingBench& bench, const std::string& scene,
                                  const std::vector<Shown>& shown);
/// A mapping's label without "Reinhard 2005, ": keys of plots and names of images must be short. Texts that
/// use it say kShortLabels.
std::string short_label(const std::string& label);
inline constexpr const char* kShortLabels = "Variants without a name: Reinhard 2005";

/// All of them, in the order of the enumeration.
std::vector<Shown> all_shown();

/// What a surface under unchanged light goes through over a motion: the mean change of luma along epipolar
/// lines (LineChange::mean), added up from the first frame on; 0 at the first. A frame of which less than
/// kEnoughOfAFrame takes part adds nothing. How far and how fast a mapping
/// adapts, without what enters and leaves the view.
std::vector<double> adaptation_track(const MappedMotion& motion);

}  // namespace plenolab
