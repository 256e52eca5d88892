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
  /// Of the visibly wrong restored pixels, the share where the truth shows a surface nearer by more than 1 px
  /// of disparity than what was restored: background painted over an occluder.
  double painted_over_share = 0;
};

/// Finds the position where `measure` shows most (nothing if it shows nowhere), renders the truth there, and
/// adds pictures and rows. `region` names the effect's pixels in the rows.
std::optional<RestorationStudy> study_restoration(ReproductionResult& result, Laboratory& laboratory,
                                                  const std::string& scene, const EffectMeasure& measure,
                                                  const std::string& region);

}  // namespace plenolab
