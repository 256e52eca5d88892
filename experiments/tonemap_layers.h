#pragma once

#include <filesystem>

#include "analysis/result_table.h"
#include "core/tonemap/bilateral.h"

namespace plenolab {

/// Pictures of the layers of the bilateral operator as in figures 22 and 25 of Altmeier's thesis:
///   base.png, temporary.png     log luminance from the smallest to the largest value of both, black to white
///   detail.png, foreground.png  0 is middle grey; black and white are −s and +s, s the 99th percentile of
///                               the absolute values of both (what lies beyond is cut, and counted)
///   layers.exr                  r, g, b of the result and the layers as they are, in log10 units, in
///   channels
///                               log_luminance, base, detail, foreground, temporary
/// Foreground and temporary layer are those of the enhanced operator; where there is none they are left out.
/// Returns rows base_min, base_max, detail_scale (log10 units) and detail_cut (px).
ResultTable write_layers(const BilateralLayers& layers, const DisplayImage& result,
                         const std::filesystem::path& folder);

}  // namespace plenolab
