#pragma once

#include <optional>
#include <string>

#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"

namespace plenolab {

/// Largest disparity of what counts as far background in these figures.
inline constexpr float kFarBackground_px = 1;

/// Restored pixels where the truth shows the far background: what they show instead plays no part.
Mask restored_before_background(const Mask& restored, const DisparityMap& truth);

/// What figures 31 and 32 share: one position shown true, synthesised before and after restoration (rule 4),
/// with its visibility and differences, and the errors of restored pixels apart from the others.
struct RestorationStudy {
  Place place;
  std::optional<MaskedNumbers> effect;    ///< pixels of the effect that the place was chosen for
  std::optional<MaskedNumbers> restored;  ///< all restored pixels
  std::optional<MaskedNumbers> others;    ///< all pixels that were not restored
  PictureNumbers pictures;                ///< [0] before, [1] after restoration
  /// Restored pixels where the truth shows the far background (disparity of at most kFarBackground_px),
  /// whatever restoration shows there.
  std::optional<MaskedNumbers> background;
  /// Of these, how many restoration gets wrong: it shows something nearer, or the colour differs visibly.
  double background_nearer_share = 0, background_failed_share = 0;
};

/// Which part is enlarged.
enum class RestorationCrop {
  kWorst,       ///< where pixels of the effect are farthest from the truth
  kBackground,  ///< where most pixels are restored that show the far background in the truth
};

/// Finds the position where `measure` shows most (nothing if it shows nowhere), renders the truth there, and
/// adds pictures and rows. `region` names the effect's pixels in the rows.
std::optional<RestorationStudy> study_restoration(ReproductionResult& result, Laboratory& laboratory,
                                                  const std::string& scene, const EffectMeasure& measure,
                                                  const std::string& region, RestorationCrop enlarged);

}  // namespace plenolab
