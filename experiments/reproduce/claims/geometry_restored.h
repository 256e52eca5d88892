#pragma once

#include <vector>

#include "core/synthesis/novel_view.h"
#include "experiments/reproduce/claims/geometry_measure.h"

namespace plenolab {

/// Errors of restored background (claim A-G6).

/// Restored background counts as truly background if the true view shows a surface of its disparity, to what
/// rule 2 tells surfaces apart by.
inline constexpr double kSameSurface_px = 1;

/// Errors of one view, or of several of one stimulus.
struct RestorationErrors {
  ErrorSum background;  ///< restored pixels where the true view shows background
  ErrorSum foreground;  ///< restored pixels where the true view shows something nearer: lost structures
  ErrorSum rest;        ///< pixels that needed no restoration
  RestorationErrors& operator+=(const RestorationErrors& other);
};

/// The view needs its provenance.
RestorationErrors restoration_errors(const NovelView<SceneReferred>& view,
                                     const KeyView<SceneReferred>& truth, float exposure);

RestorationErrors pooled(const std::vector<RestorationErrors>& units);

/// RMS error in restored background over that of the rest of the same views, with a 95 % bootstrap interval
/// over the units in which background was restored: what one unit shows is drawn together. Empty for fewer
/// than two of them, or if the rest has no error.
std::optional<Interval> restored_over_rest(const std::vector<RestorationErrors>& units, std::uint64_t seed);

}  // namespace plenolab
