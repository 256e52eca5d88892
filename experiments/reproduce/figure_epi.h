#pragma once

#include <string>
#include <vector>

#include "experiments/reproduce/figure_tools.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// Frames of the figures' epipolar images.
inline constexpr int kEpiFrames = 41;

/// The same row of frames of a horizontal camera motion, synthesised and true, frame 0 at the top.
struct EpiPair {
  std::vector<CameraPosition> positions;
  SceneImage truth, synthesised;
  int row = 0;
  int frame = 0;  ///< nearest to the position of the figure's view
};

/// Up to one spacing to either side of `at`, as far as the grid reaches, in kEpiFrames frames. Of the true
/// views only the row is rendered.
EpiPair record_epi(Laboratory& laboratory, const std::string& scene, CameraPosition at, int row);

/// What an epipolar image says about the part of the row that is enlarged.
struct EpiNumbers {
  double psnr_db = 0;  ///< all frames, columns of the box
  /// RMS difference of encoded luma smoothed over 5 columns, mean over frames on (or next to) a column of key
  /// views.
  double rms_at_keys = 0;
  double rms_between = 0;  ///< the same over frames midway between two columns
};

/// Adds the epipolar images (truth, synthesis, difference; the frame of the view marked green, what is
/// enlarged red), the columns of the box enlarged, and the error of these columns over the camera position
/// as a plot. Rows: epi_psnr_gamma_db, epi_rms_at_keys, epi_rms_between with the columns given.
EpiNumbers add_epi(ReproductionResult& result, const EpiPair& epi, const PixelBox& box, float exposure,
                   const std::string& what, const Columns& columns);

}  // namespace plenolab
