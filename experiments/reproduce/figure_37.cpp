#include <fmt/format.h>

#include <cmath>

#include "experiments/reproduce/figure_appearance.h"

namespace plenolab {

ReproductionResult reproduce_cut_shaft(Laboratory& laboratory);

namespace {

std::string border_sentence(const BorderErrors& borders) {
  return fmt::format(
      " The error is {:.3f} (encoded RMS) within {} px of borders of visibility and {:.3f} elsewhere in the "
      "enlarged part{}.",
      borders.beside, kBesideBorder_px, borders.elsewhere,
      borders.beside > borders.elsewhere ? ""
                                         : ": not the edge, but what else is wrong there (copies of shafts, "
                                           "noise) makes up most of it");
}

/// Why the edge need not vanish in the columns of key views.
std::string path_sentence(CameraPosition position) {
  if (position.t == std::round(position.t)) return "";
  return fmt::format(
      " The camera moves along t = {:.2f}, between two rows of key views: in a column of key views two of "
      "them "
      "are still blended, and the edge remains where only one of these sees the wall.",
      position.t);
}

}  // namespace

ReproductionResult reproduce_cut_shaft(Laboratory& laboratory) {
  ReproductionResult result;
  const AppearanceStudy study = study_appearance(
      result, laboratory,
      {.scene = "cellar-shafts",
       .seen = "Seen: where the visibility map changes colour on one surface, the share of a "
               "key view that no longer sees it, with its copy of the shaft, drops out from "
               "one pixel to the next.",
       .offsets = offsets_inside_cells().first(1),
       .at_borders = true});
  result.paper_shows =
      "Figure 37 shows a light shaft cut off at a sharp edge: where an occluder hides the wall from some key "
      "views, their share of the shaft's light is missing. The edge is a border of visibility and fades in "
      "the epipolar image as the shares of the key views change.";
  result.ours_shows = fmt::format(
      "View from {}. {} The error there is {:.1f} times that of the rest of the view, PSNR {:.1f} dB (whole "
      "view {:.1f} dB). {} {}",
      name_of(study.place.view.position), study.choice, study.error_concentration,
      study.pictures.box[0].psnr_db, study.pictures.whole[0].psnr_db, fading_text(*study.epi),
      overview_text(study.overview));
  const bool concentrates = study.error_concentration > 1;
  if (concentrates && fades(*study.epi))
    result.differs =
        "They agree: the error is larger around this border of visibility than elsewhere, and fades towards "
        "the columns of key views.";
  else
    result.differs = fmt::format(
        "They differ: the error around this border of visibility {} in this run.{}",
        concentrates ? "does not fade towards the columns of key views" : "is no larger than elsewhere",
        path_sentence(study.place.view.position));
  result.differs += border_sentence(*study.borders);
  return result;
}

}  // namespace plenolab
