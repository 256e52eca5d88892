#include <fmt/format.h>

#include "experiments/reproduce/figure_restoration.h"

namespace plenolab {

ReproductionResult reproduce_beam_at_frustum_border(Laboratory& laboratory);

ReproductionResult reproduce_beam_at_frustum_border(Laboratory& laboratory) {
  constexpr const char* kScene = "cellar";
  ReproductionResult result;
  result.paper_shows =
      "Figure 31 shows a failure in the Cellar: background beside a vertical timber beam that some key views "
      "hide behind the beam and the others do not cover. Restoring it from neighbouring background pixels "
      "leaves artefacts, because the background is not uniform.";
  const auto study = study_restoration(result, laboratory, kScene, unseen_beyond_frustum,
                                       "unseen beyond the frustum", RestorationCrop::kWorst);
  if (!study) {
    result.ours_shows =
        "At none of the positions searched did our Cellar hide background from some key views while the "
        "others do not cover it: the failure does not occur in this run.";
    result.differs = "Nothing can be compared.";
    return result;
  }
  const MaskedNumbers& effect = *study->effect;
  const bool fails = study->others && effect.psnr_db < study->others->psnr_db;
  result.ours_shows = fmt::format(
      "From {}, of {} positions the one where it shows most in one crop, {} pixels of background are hidden "
      "in every key view that covers them and lie outside the image of at least one other. Before "
      "restoration they are black. Restored, {} of them differ visibly from the truth, and their PSNR is "
      "{:.1f} dB against {:.1f} dB of the pixels that needed no restoration. The true background varies by "
      "{:.2f} (standard deviation of encoded luma) over these pixels, which is what restoration cannot know.",
      name_of(study->place.view.position), study->place.searched, effect.pixels,
      percent(effect.visible_share), effect.psnr_db, study->others ? study->others->psnr_db : 0.0,
      effect.truth_spread);
  result.differs =
      fails
          ? "They agree: background that some key views hide and others do not cover is restored worse than "
            "the pixels that needed no restoration are synthesised."
          : "They differ: in our Cellar the restored pixels are no worse than the others at this position.";
  return result;
}

}  // namespace plenolab
