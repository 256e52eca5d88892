#include <fmt/format.h>

#include "experiments/reproduce/figure_restoration.h"

namespace plenolab {

ReproductionResult reproduce_restored_sky(Laboratory& laboratory);

ReproductionResult reproduce_restored_sky(Laboratory& laboratory) {
  constexpr const char* kScene = "tree";
  constexpr double kFewVisible = 0.2;  // share of restored pixels that may differ visibly in a success
  ReproductionResult result;
  result.paper_shows =
      "Figure 32 shows a success in the Tree scene: sky seen through holes in the foliage that no key view "
      "sees is restored from neighbouring sky, and appears free of artefacts because the sky is uniform.";
  const auto study = study_restoration(result, laboratory, kScene, restored_pixels, "restored by rule 4");
  if (!study) {
    result.ours_shows =
        "At none of the positions searched was a pixel of our Tree unseen in all key views: nothing had to "
        "be "
        "restored in this run.";
    result.differs = "Nothing can be compared.";
    return result;
  }
  const MaskedNumbers& restored = *study->restored;
  const bool success = restored.visible_share < kFewVisible;
  result.ours_shows = fmt::format(
      "From {}, of {} positions the one with most restored pixels in one crop, {} pixels are seen by no key "
      "view "
      "and restored. {} of them differ visibly from the truth (encoded difference above {}), against {} of "
      "the "
      "other pixels; PSNR {:.1f} dB against {:.1f} dB. Restoration raises the PSNR of the enlarged part from "
      "{:.1f} to {:.1f} dB. The truth varies by {:.2f} (standard deviation of encoded luma) over the "
      "restored "
      "pixels.",
      name_of(study->place.view.position), study->place.searched, restored.pixels,
      percent(restored.visible_share), kVisibleDifference,
      study->others ? percent(study->others->visible_share) : "none", restored.psnr_db,
      study->others ? study->others->psnr_db : 0.0, study->pictures.box[0].psnr_db,
      study->pictures.box[1].psnr_db, restored.truth_spread);
  const std::string painted_over = fmt::format(
      "{} of the visibly wrong ones show sky where the truth has a leaf or twig: these belong to the loss of "
      "fine "
      "structures of figure 33.",
      percent(study->painted_over_share));
  result.differs =
      (success
           ? "They agree: with sky behind the leaves, restoration leaves few visible errors. "
           : "They agree only in part: many restored pixels are visibly wrong, which the thesis, judging by "
             "eye, does not report. ") +
      painted_over;
  return result;
}

}  // namespace plenolab
