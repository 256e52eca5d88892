#pragma once

#include "core/tonemap/bilateral.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/tone_scene.h"
#include "experiments/tonemap_layers.h"

namespace plenolab {

/// The bilateral operator with one compression and one brightness for a whole scene, as it maps its light
/// field.
BilateralToneParameters fit_bilateral(const ToneScene& scene, const BilateralToneOptions& options,
                                      int threads = 0);

/// A key view of the cellar, as in figures 22 and 25, through one variant of the operator.
struct BilateralView {
  std::string title;  ///< of scene and view
  BilateralToneParameters parameters;
  BilateralLayers layers;
  DisplayImage mapped;
  LayerPictures shown;
};

BilateralView map_middle_of_cellar(Laboratory& laboratory, const ToneScene& cellar, bool enhanced);

/// "Cellar" as tone_scene gives it.
ToneScene cellar_scene(Laboratory& laboratory);

/// Range between the 1st and 99th percentile of a layer, log10 units.
double range_without_outliers(const Plane<float>& layer);

/// Adds the rows compression, brightness, range_luminance, range_base, range_target, detail_scale and
/// detail_cut with the column operator.
void add_view_rows(ReproductionResult& result, const BilateralView& view, const std::string& name);

}  // namespace plenolab
