#include <fmt/format.h>

#include "experiments/reproduce/figure_appearance.h"

namespace plenolab {

ReproductionResult reproduce_mirror_copies(Laboratory& laboratory);

ReproductionResult reproduce_mirror_copies(Laboratory& laboratory) {
  ReproductionResult result;
  const AppearanceStudy study =
      study_appearance(result, laboratory,
                       {.scene = "tunnel",
                        .seen = "Seen: what the wet surface reflects, where each key view saw it.",
                        .offsets = offsets_on_rows()});
  const ErrorNumbers &inside = study.pictures.box[0], &whole = study.pictures.whole[0];
  result.paper_shows =
      "Figure 35 shows the wet walls of the Tunnel: reflections move across the surface when the camera "
      "moves, the blend of key views keeps them where each key view saw them, and so copies of lamps and of "
      "the sky appear beside each other and fade in and out. The thesis calls this not satisfactory.";
  result.ours_shows = fmt::format(
      "View from {}. {} PSNR {:.1f} dB and SSIM {:.3f} there, {:.1f} dB and {:.3f} in the whole view; {} of "
      "the enlarged pixels differ visibly (encoded difference above {}). {} {}",
      name_of(study.place.view.position), study.choice, inside.psnr_db, inside.ssim, whole.psnr_db,
      whole.ssim, percent(inside.visible_share), kVisibleDifference, fading_text(*study.epi),
      overview_text(study.overview));
  result.differs =
      fades(*study.epi)
          ? "They agree in kind: in this part the error is larger between key views than at them, as copies "
            "of "
            "reflections make it. The numbers above say how much larger. "
          : "They differ: the error changes little between key views and the positions between them, so that "
            "copies of reflections are not what dominates it in this run. ";
  result.differs += elsewhere_text(study);
  return result;
}

}  // namespace plenolab
