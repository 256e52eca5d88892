#pragma once

#include "core/synthesis/epipolar_path.h"
#include "core/synthesis/prepared_view.h"

namespace plenolab {

/// The keep_thin variant. Rule 2 discards every correspondence between two surfaces, and a surface narrower
/// than 2 × 2 px consists of nothing else, so it vanishes (thesis, sections 4.1.4 and 6.1.1). Two things lose
/// it: its pixels form tents in the bilinear disparity map that search paths pass over, and where a path hits
/// a tent, rule 2 discards it.
///
/// A pixel q is *thin* if all 2 × 2 neighbourhoods that contain it span more than `disocclusion_px` and it is
/// nearer than the farthest pixel of each by more than that. Thin pixels are projected forward with their own
/// disparity D, to q − b·D; the pixel of the novel view whose centre lies within half a pixel of that point
/// (both axes) takes q as its correspondence in that view, at q's centre, if D is nearer than what the search
/// found there. Among several thin pixels the nearest wins. Because every key view has rounded the
/// structure's outline to its own pixels, and because a wrong disparity in a single view is a thin pixel too,
/// a pixel keeps its thin correspondences only if views with at least half of the bilinear weight (of those
/// in frustum) show that surface, to δ_occ.
struct ThinSplats {
  Plane<float>
      disparity;      ///< of the nearest thin pixel that lands on each pixel of the novel view, −1 for none
  Plane<int> source;  ///< its index y·width + x in the key view
};

ThinSplats splat_thin_pixels(const PreparedView& view, const EpipolarPath& path, double disocclusion_px);

}  // namespace plenolab
