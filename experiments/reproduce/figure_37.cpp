#include <fmt/format.h>

#include "experiments/reproduce/figure_appearance.h"

namespace plenolab {

ReproductionResult reproduce_cut_shaft(Laboratory& laboratory);

ReproductionResult reproduce_cut_shaft(Laboratory& laboratory) {
  ReproductionResult result;
  const AppearanceStudy study = study_appearance(
      result, laboratory,
      {.scene = "cellar-shafts", .offsets = offsets_inside_cells().first(1), .at_borders = true});
  result.paper_shows =
      "Figure 37 shows a light shaft cut off at a sharp edge: where an occluder hides the wall from some key "
      "views, their share of the shaft's light is missing. The edge is a border of visibility and fades in "
      "the epipolar image as the shares of the key views change.";
  result.ours_shows = fmt::format(
      "View from {}, the centre of the cell, of {}, where losing key views at borders of visibility changes "
      "the blend most within one crop, which is enlarged. The error there is {:.1f} times that of the rest "
      "of the view, PSNR {:.1f} dB (whole view {:.1f} dB). {}",
      name_of(study.place.view.position), study.place.searched, study.error_concentration,
      study.pictures.box[0].psnr_db, study.pictures.whole[0].psnr_db, fading_text(*study.epi));
  const bool concentrates = study.error_concentration > 1;
  if (concentrates && fades(*study.epi))
    result.differs =
        "They agree: the error is larger around this border of visibility than elsewhere, and fades towards "
        "the columns of key views.";
  else
    result.differs = fmt::format(
        "They differ: the error around this border of visibility {} in this run.",
        concentrates ? "does not fade towards the columns of key views" : "is no larger than elsewhere");
  return result;
}

}  // namespace plenolab
