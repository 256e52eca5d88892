#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiments/reproduce/figure_epi.h"
#include "experiments/reproduce/figure_overview.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"

namespace plenolab {

/// What figures 34 to 37 share: one position shown true and synthesised, enlarged where the effect shows most
/// (found without the truth), with visibility, difference and, if wanted, epipolar images through the
/// enlarged part.
struct AppearanceOptions {
  std::string scene;
  std::string seen;                         ///< what is to be seen, a sentence for the captions; may be empty
  std::span<const CameraPosition> offsets;  ///< positions searched, in each cell
  bool at_borders = false;  ///< look for jumps at visibility borders, otherwise for disagreement of key views
  bool with_epi = true;
  bool with_sparser_grid =
      false;  ///< also synthesise from every other key view, where the position allows it
};

/// Pixels this near to where key views cease to contribute are beside a border of visibility.
inline constexpr int kBesideBorder_px = 2;

/// RMS error of encoded luma, smoothed over 3 × 3 px, in the enlarged part. 0 where there are no such pixels.
struct BorderErrors {
  double beside = 0, elsewhere = 0;
};

struct AppearanceStudy {
  Place place;
  std::string choice;           ///< how position and enlarged part were chosen, in sentences
  PictureNumbers pictures;      ///< [0] the synthesis, [1] from every other key view if it was made
  double rms_disagreement = 0;  ///< of the effect over the enlarged part: encoded luma
  /// Root of the mean squared smoothed error of the enlarged part over that of all other pixels: how much the
  /// error concentrates there. 0 if the others have none.
  double error_concentration = 0;
  std::optional<EpiNumbers> epi;
  std::optional<BorderErrors> borders;  ///< if looked for
  Overview overview;                    ///< the same numbers at places that were not chosen
};

/// Whether the error grows between key views elsewhere, too, in words; empty where that is not known.
std::string elsewhere_text(const AppearanceStudy& study);

AppearanceStudy study_appearance(ReproductionResult& result, Laboratory& laboratory,
                                 const AppearanceOptions& options);

}  // namespace plenolab
