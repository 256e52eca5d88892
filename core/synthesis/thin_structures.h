#pragma once

#include <array>
#include <memory>

#include "core/synthesis/epipolar_path.h"
#include "core/synthesis/patch_blend.h"
#include "core/synthesis/prepared_view.h"

namespace plenolab {

/// The keep_thin variant. Rule 2 discards every correspondence between two surfaces, and a surface narrower
/// than 2 × 2 px consists of nothing else, so it vanishes; wider ones lose about half a pixel a side (thesis,
/// sections 4.1.4 and 6.1.1). Two things lose them: outermost pixels end in slopes of the bilinear disparity
/// map that search paths pass over, and where a path hits a slope, rule 2 discards it.
///
/// An *edge pixel* is one that shares a 2 × 2 neighbourhood with a pixel farther by more than the threshold
/// of rule 2; all pixels of a thin structure are edge pixels. They are projected forward with their own
/// disparity D, to q − b·D; the pixel of the novel view whose centre lies within half a pixel of that point
/// (both axes) takes q as its correspondence in that view, at q's centre, if D is nearer than what the search
/// found there by more than δ_occ. Among several edge pixels that land on one pixel the nearest wins. Because
/// every key view has rounded the outline to its own pixels, and because a wrong disparity in a single view
/// looks like a thin structure too, a pixel takes edge pixels only if the views that show a surface at that
/// disparity, to δ_occ, or nearer have at least half of the bilinear weight of all views that show a surface
/// there (in frustum and past rule 2).
///
/// Bars of 0.5, 1, 2, 3, 4 px come out 0.6, 1.2, 2.25, 3.25, 4.25 px wide, with the standard rules 0, 0,
/// 0.85, 2.1, 3.1 px (means over sub-pixel places, tests/core/synthesis/test_thin_structures.cpp).
struct ThinSplats {
  Plane<float>
      disparity;      ///< of the nearest edge pixel that lands on each pixel of the novel view, −1 for none
  Plane<int> source;  ///< its index y·width + x in the key view
};

/// Projects the edge pixels of one key view.
ThinSplats splat_edge_pixels(const PreparedView& view, const EpipolarPath& path, double disocclusion_px);

/// Replaces hits of a patch by edge pixels where the views agree; marks them in PatchView::thin. Returns how
/// many.
std::uint64_t keep_edge_pixels(const BlendSetup& setup,
                               const std::array<std::unique_ptr<ThinSplats>, kMaxViews>& splats,
                               const Patch& patch, PatchViews& views);

}  // namespace plenolab
