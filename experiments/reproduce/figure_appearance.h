#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiments/reproduce/figure_epi.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"

namespace plenolab {

/// What figures 34 to 37 share: one position shown true and synthesised, enlarged where the error of
/// pixels that every key view sees is largest (at borders: where the effect shows most), with visibility,
/// difference and, if wanted, epipolar images through the enlarged part.
struct AppearanceOptions {
  std::string scene;
  std::span<const CameraPosition> offsets;  ///< positions searched, in each cell
  bool at_borders = false;  ///< look for jumps at visibility borders, otherwise for disagreement of key views
  /// Enlarge where neighbouring pixels share an error, not where it differs from pixel to pixel: for scenes
  /// that glitter.
  bool coherent = false;
  bool with_epi = true;
  bool with_sparser_grid =
      false;  ///< also synthesise from every other key view, where the position allows it
};

struct AppearanceStudy {
  Place place;
  PictureNumbers pictures;      ///< [0] the synthesis, [1] from every other key view if it was made
  double rms_disagreement = 0;  ///< of the effect over the enlarged part: encoded luma
  /// Root of the mean squared smoothed error of the enlarged part over that of all other pixels: how much the
  /// error concentrates there. 0 if the others have none.
  double error_concentration = 0;
  std::optional<EpiNumbers> epi;
};

AppearanceStudy study_appearance(ReproductionResult& result, Laboratory& laboratory,
                                 const AppearanceOptions& options);

}  // namespace plenolab
