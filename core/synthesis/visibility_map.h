#pragma once

#include "core/synthesis/novel_view.h"

namespace plenolab {

/// The false-colour picture of visibility (thesis, section 6.1.1): green where every participating key view
/// sees the surface, red where none does (before restoration), hues between by the count; brightness follows
/// the novel view's luma so that the scene stays recognisable, but only between 60 % and 100 %, so that the
/// hues can be told apart at night too. Scene-referred views are exposed to their own 99th percentile first;
/// unseen pixels are full red.
DisplayImage visibility_map(const NovelView<SceneReferred>& view);
DisplayImage visibility_map(const NovelView<DisplayReferred>& view);

/// Share of pixels for which nothing at all was found, 0 … 1.
template <class Referral>
double unseen_rate(const NovelView<Referral>& view) {
  return view.image.empty()
             ? 0
             : static_cast<double>(view.unseen_pixels) / static_cast<double>(view.image.size());
}

}  // namespace plenolab
