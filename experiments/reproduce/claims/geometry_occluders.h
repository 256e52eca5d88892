#pragma once

#include <string>
#include <vector>

#include "core/synthesis/novel_view.h"
#include "experiments/reproduce/claims/geometry_shapes.h"
#include "experiments/reproduce/claims/probes.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// Random flat occluders before a flat background, seen by the four key views of one cell: which of them
/// leave background that no key view has seen? (Thesis, section 4.1.5.) Only visibility matters, so surfaces
/// are plain.
///
/// Occluders are larger than what they move by against the background from one key view to the next: past a
/// smaller one, opposite key views see everything, and no claim about unseen points would be put to the test.

/// Image size of these probes.
inline constexpr int kOccluderWidth = 128, kOccluderHeight = 96;

/// One or two occluders and what lies behind them.
struct OccluderPlacement {
  std::vector<Shape> shapes;           ///< centred as the middle of the cell sees them
  std::vector<double> disparities_px;  ///< of each shape
  double background_px = 0;            ///< disparity of the background
};

/// The grid of the probes: one cell of four key views.
ViewGrid occluder_grid();

/// A single occluder that lies in all four frustums together with everything it hides.
OccluderPlacement place_inside(ShapeKind kind, RandomStream& random);
/// Two occluders of one kind side by side, all in the four frustums; 2 to 6 px lie between them as the middle
/// of the cell sees it, about as much as they move by against the background from there to a key view.
OccluderPlacement place_pair(ShapeKind kind, RandomStream& random);
/// A single occluder of which the key views on one side see a part at the border of their image, and the
/// opposite ones nothing, before a background that is not infinitely far away, so that the frustums differ
/// there. Of the bars, a beam along the border and longer than the image, as in figure 31.
OccluderPlacement place_at_border(ShapeKind kind, RandomStream& random);

/// What of a world carries patterns; the rest is of plain colours.
enum class Patterned { kNothing, kOccluders, kEverything };

/// The placement as a world.
FlatWorld world_of(const OccluderPlacement& placement, Patterned patterned);

/// Positions from which a placement is looked at: the cell's centre and four random points of the cell, not
/// nearer than a tenth to its sides.
std::vector<CameraPosition> positions_in_cell(std::uint64_t seed);

/// 1 where the surface that a pixel's centre shows is hidden from, or outside the image of, all four corner
/// views: geometry alone, without sampling or search. The farthest surface must be endless.
Mask hidden_from_all(const FlatWorld& world, const ViewGrid& grid, CameraPosition position);

/// Why pixels beyond the rim are unseen in synthesis; numbers of pixels.
struct UnseenCauses {
  double hidden = 0;  ///< the surface is hidden from, or outside of, all four key views
  double behind = 0;  ///< every key view that shows it shows an occluder across the path of the search before
                      ///< it: the search ends there, though the ray passes behind
  double beside = 0;  ///< a key view shows it on a free path: lost beside an edge (rules 2 and 3, sampling)
  double all() const { return hidden + behind + beside; }
};

/// What synthesis and geometry say about one placement.
struct OccluderOutcome {
  UnseenCauses unseen_px;  ///< mean over the positions
  double geometry_px = 0;  ///< beyond the rim, mean over the positions: truly hidden from all key views
  bool unseen = false;     ///< at any position some pixel beyond the rim was unseen
  bool hidden = false;     ///< at any position some pixel beyond the rim was truly hidden
  bool unseen_2x2 = false, hidden_2x2 = false;  ///< the same where only strips of one pixel count as rim
  CameraPosition worst;                         ///< position with most unseen pixels
};
OccluderOutcome judge(const OccluderPlacement& placement, std::uint64_t seed, int threads);

/// All placements of one kind.
struct OccluderStudy {
  ShapeKind kind = ShapeKind::kDisc;
  std::string name = {};  ///< of the kind, for rows and plots
  std::vector<OccluderPlacement> placements;
  std::vector<OccluderOutcome> outcomes;
  std::size_t unseen() const;  ///< placements that leave unseen background
  std::size_t hidden() const;
};

/// How placements are drawn.
using Placing = OccluderPlacement (*)(ShapeKind kind, RandomStream& random);

/// `count` placements of each kind, judged side by side on the laboratory's threads. `purpose` keeps the
/// random numbers of claims apart.
std::vector<OccluderStudy> study_occluders(Laboratory& laboratory, std::span<const ShapeKind> kinds,
                                           Placing placing, int count, std::uint64_t purpose);

/// The same for geometry alone, without synthesis: of the outcomes only `hidden`, `hidden_2x2` and
/// `geometry_px` mean anything. So much faster that rare cases can be counted.
std::vector<OccluderStudy> study_geometry(Laboratory& laboratory, std::span<const ShapeKind> kinds,
                                          Placing placing, int count, std::uint64_t purpose);

/// Placements per kind in this run: `wanted`, or 2 in a tiny one.
int placements_per_kind(const Laboratory& laboratory, int wanted);

/// "Never" cannot be shown by sampling; "in less than one placement of twenty" can, with about a hundred of
/// them (24 of each of four kinds): none of 96 gives a 95 % interval up to 3.8 %. Claims that occluders can
/// cause unseen points are held to the same share.
inline constexpr double kOftenShare = 0.05;

/// What leaves the background unseen: synthesis (no key view contributes before restoration), or geometry
/// alone (it is hidden from, or outside of, all key views).
enum class UnseenBy { kSynthesis, kGeometry };

std::size_t unseen_of(const OccluderStudy& study, UnseenBy by);
std::size_t placements_of(const std::vector<OccluderStudy>& studies);
/// The kind that leaves unseen background in the fewest placements; the first of equal ones.
const OccluderStudy& rarest_of(const std::vector<OccluderStudy>& studies, UnseenBy by);
/// "hidden_placement_share" or "unseen_placement_share".
const char* quantity_of(UnseenBy by);

/// Share of placements with unseen background over several kinds, with its interval.
Interval unseen_share(const std::vector<OccluderStudy>& studies, UnseenBy by = UnseenBy::kSynthesis);

/// Mean over all placements.
UnseenCauses mean_causes(const std::vector<OccluderStudy>& studies);
/// "12 % of … are truly hidden, …" for the causes; empty where nothing is unseen.
std::string causes_text(const UnseenCauses& causes);

/// Rows of a study (columns occluders, kind), and a bar chart of the share of placements with unseen
/// background by kind beside the share that geometry predicts.
void add_study(ReproductionResult& result, const std::vector<OccluderStudy>& studies, const std::string& set);
ReportPlot plot_of(const std::vector<OccluderStudy>& studies, std::string caption);
/// Rows and plot with the numbers of geometry from a study of their own, kinds in the same order.
void add_geometry_study(ReproductionResult& result, const std::vector<OccluderStudy>& geometry,
                        const std::string& set);
ReportPlot plot_of(const std::vector<OccluderStudy>& studies, const std::vector<OccluderStudy>& geometry,
                   std::string caption);

/// Truth, synthesised view and visibility map of the placement with most unseen background.
void add_worst_case(ReproductionResult& result, const std::vector<OccluderStudy>& studies,
                    const std::string& name, int threads);

}  // namespace plenolab
