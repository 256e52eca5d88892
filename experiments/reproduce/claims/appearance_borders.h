#pragma once

#include <vector>

#include "experiments/reproduce/claims/appearance_measures.h"

namespace plenolab {

/// Errors along borders of visibility: between neighbouring pixels of one surface that different sets of key
/// views see.

/// Squared steps of the error S − T across such borders in the middle half of the image, noise taken out as
/// in tile_errors; one mean for each image row with at least one border. Pixels next to the edge of another
/// surface are left out: there, errors of geometry of up to a pixel would count too.
std::vector<double> squared_border_steps(std::span<const TwinView> views);

inline constexpr int kErrorBlock_px = 8;

/// Error of a view of a scene of the table, whose truth is rendered once.
struct SceneError {
  float exposure = 1;
  /// Squared means of the encoded error over kErrorBlock_px² pixels (all channels), row by row.
  std::vector<double> squared_blocks;
  /// Mean absolute step of the error's luma across borders of visibility, less that between other neighbours
  /// of one surface; 0 without borders.
  double border_excess = 0;
  ImageComparison comparison;
  SceneImage truth, synthesised;
};

/// `exposure` 0 = from the truth.
SceneError scene_error(Laboratory& laboratory, const std::string& scene_id, CameraPosition position,
                       float exposure = 0);

}  // namespace plenolab
