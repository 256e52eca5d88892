#pragma once

#include <optional>
#include <string>

#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"

namespace plenolab {

/// What figures 31 and 32 share: one position shown true, synthesised before and after restoration (rule 4),
/// with its visibility and differences, and the errors of restored pixels apart from the others.
struct RestorationStudy {
  Place place;
  std::optional<MaskedNumbers> effect;    ///< pixels of the effect that the place was chosen for
  std::optional<MaskedNumbers> restored;  ///< all restored pixels
  std::optional<MaskedNumbers> others;    ///< all pixels that were not restored
  PictureNumbers pictures;                ///< [0] before, [1] after restoration
  /// Restored pixels where truth and restoration both show the far background (disparity of at most 1 px).
  std::optional<MaskedNumbers> background;
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
