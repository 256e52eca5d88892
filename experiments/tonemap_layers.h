#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/result_table.h"
#include "core/tonemap/bilateral.h"

namespace plenolab {

struct LayerPicture {
  std::string name;  ///< "base", "detail", "temporary" or "foreground"
  DisplayImage image;
};

/// Pictures of the layers of the bilateral operator as in figures 22 and 25 of Altmeier's thesis:
///   base, temporary     log luminance from the smallest to the largest value of both, black to white,
///   without
///                       a share `base_outliers` in [0, 0.2] of their values at each end
///   detail, foreground  0 is middle grey; black and white are −s and +s, s the 99th percentile of the
///                       absolute values of both (what lies beyond is cut, and counted)
/// Foreground and temporary layer are those of the enhanced operator; where there is none they are left out.
struct LayerPictures {
  std::vector<LayerPicture> pictures;
  BaseRange base_range;         ///< black and white of base and temporary, log10 units
  double detail_scale = 0;      ///< s, log10 units
  std::int64_t detail_cut = 0;  ///< values beyond it
};
LayerPictures picture_layers(const BilateralLayers& layers, double base_outliers = 0.01);

/// base_m − foreground, empty without a foreground layer.
Plane<float> temporary_layer(const BilateralLayers& layers);

/// Writes these pictures as base.png …, and layers.exr: r, g, b of the result and the layers as they are, in
/// log10 units, in channels log_luminance, base, detail, foreground, temporary. Returns rows base_min,
/// base_max, detail_scale (log10 units) and detail_cut (px).
ResultTable write_layers(const BilateralLayers& layers, const DisplayImage& result,
                         const std::filesystem::path& folder);

}  // namespace plenolab
