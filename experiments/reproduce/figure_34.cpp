#include <fmt/format.h>

#include "experiments/reproduce/figure_appearance.h"

namespace plenolab {

ReproductionResult reproduce_light_shafts(Laboratory& laboratory);

ReproductionResult reproduce_light_shafts(Laboratory& laboratory) {
  ReproductionResult result;
  const AppearanceStudy study =
      study_appearance(result, laboratory,
                       {.scene = "cellar-shafts",
                        .seen = "Seen: the light of a shaft on the wall, once for each key view.",
                        .offsets = offsets_on_rows()});
  result.paper_shows =
      "Figure 34 shows light shafts in the Cellar: their light is attributed to the wall behind them, whose "
      "points every key view sees through another part of the shaft. The synthesised view therefore shows "
      "overlapping copies of each shaft, which fade in and out in the epipolar image as the camera moves.";
  result.ours_shows = fmt::format(
      "View from {}. {} There the PSNR is {:.1f} dB (whole view {:.1f} dB), and the error is {:.1f} times "
      "that "
      "of the rest of the view. {} {}",
      name_of(study.place.view.position), study.choice, study.pictures.box[0].psnr_db,
      study.pictures.whole[0].psnr_db, study.error_concentration, fading_text(*study.epi),
      overview_text(study.overview));
  result.differs = fades(*study.epi)
                       ? "They agree: in this part the error is larger between key views than at them, as "
                         "copies of the shafts make it. "
                       : "They differ: the error changes little between key views and the positions between "
                         "them, so that copies fading in and out are not what dominates it in this run. ";
  result.differs += elsewhere_text(study);
  return result;
}

}  // namespace plenolab
