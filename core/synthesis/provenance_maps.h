#pragma once

#include <cstdint>

#include "core/synthesis/novel_view.h"

namespace plenolab {

/// Images made of the provenance of a novel view (SynthesisOptions::record_provenance).

/// Disparity of what the novel view shows at a pixel: the mean of its correspondences, weighted as they are
/// blended; 0 where nothing was found.
float shown_disparity(const PixelProvenance& pixel);
DisparityMap shown_disparity(const Plane<PixelProvenance>& provenance);

/// One bit for each key view, in the order of NovelView::views, that sees the pixel and contributes to it;
/// restored pixels have none.
Plane<std::uint8_t> contributing_views(const Plane<PixelProvenance>& provenance);

}  // namespace plenolab
