#pragma once

#include <vector>

#include "experiments/reproduce/claims/appearance_measures.h"

namespace plenolab {

/// The floor probe as claims A-A2, A-A3 and A-A5 use it. They share its renderings.

/// Spacing of the key views that stands for a sparse grid: 0.07 of the distance of the floor in the image
/// centre (2.8 m planar depth along the middle ray: 1.6 m / sin 35°), so that the lamps' reflections are
/// displaced by 5 to 10 px between neighbouring key views.
inline constexpr double kSparseSpacing_m = 0.3;
inline constexpr double kFloorDepth_m = 2.79;

/// Views of a floor at two positions within the cell.
std::vector<TwinView> floor_views(Laboratory& laboratory, const FloorLook& look, double spacing_m);

/// How the synthesised view shows one lamp's reflection.
struct LampCopies {
  int spots = 0;  ///< bright spots in the synthesised view where the truth has one reflection
  int truth_spots = 0;
  /// Autocorrelation of the synthesised view at the displacement between copies in horizontally neighbouring
  /// key views, less that of the truth: 0 = no copies, 0.5 = copies side by side.
  double strength = 0;
  double displacement_px = 0;  ///< between copies
  /// Whether the view shows more spots than the truth by the same count.
  bool has_copies() const { return spots > truth_spots; }
};

/// Lamps whose reflection is to be seen: it rises by more than 0.08 above its surroundings in the truth (so
/// that a copy at a quarter of its weight is a visible difference) and all four key views see its window.
/// Spots rise by more than an eighth of the truth's height: half of one of four equal copies.
std::vector<LampCopies> copies_of_lamps(const TwinView& view, const Scene& scene, const ViewGrid& grid);
std::vector<LampCopies> copies_of_lamps(std::span<const TwinView> views, const Scene& scene,
                                        const ViewGrid& grid);

/// Mean of a member over lamps with its 95 % bootstrap interval; empty for fewer than two lamps.
std::optional<Interval> mean_spots(std::span<const LampCopies> lamps, std::uint64_t seed);
std::optional<Interval> mean_strength(std::span<const LampCopies> lamps, std::uint64_t seed);
/// Share of lamps that have copies with its Wilson interval; empty for fewer than two lamps.
std::optional<Interval> share_with_copies(std::span<const LampCopies> lamps);
/// Spots that the truth shows for each lamp by the same count; 0 for no lamps.
double mean_truth_spots(std::span<const LampCopies> lamps);

}  // namespace plenolab
