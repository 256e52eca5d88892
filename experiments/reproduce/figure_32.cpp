#include <fmt/format.h>

#include "experiments/reproduce/figure_restoration.h"

namespace plenolab {

ReproductionResult reproduce_restored_sky(Laboratory& laboratory);

ReproductionResult reproduce_restored_sky(Laboratory& laboratory) {
  constexpr const char* kScene = "tree";
  constexpr double kFewVisible = 0.2;  // share of visibly wrong pixels that still counts as a success
  ReproductionResult result;
  result.paper_shows =
      "Figure 32 shows a success in the Tree scene: sky seen through holes in the foliage that no key view "
      "sees is restored from neighbouring sky, and appears free of artefacts because the sky is uniform.";
  const auto study = study_restoration(result, laboratory, kScene, restored_pixels, "restored by rule 4",
                                       RestorationCrop::kBackground);
  if (!study) {
    result.ours_shows =
        "At none of the positions searched was a pixel of our Tree unseen in all key views: nothing had to "
        "be restored in this run.";
    result.differs = "Nothing can be compared.";
    return result;
  }
  const MaskedNumbers& restored = *study->restored;
  const MaskedNumbers background = study->background.value_or(MaskedNumbers{});
  const double background_share =
      static_cast<double>(background.pixels) / static_cast<double>(restored.pixels);
  result.ours_shows = fmt::format(
      "From {}, of {} positions the one with most restored pixels in one crop, {} pixels are seen by no key "
      "view "
      "and restored. At {} of them truth and restoration both show the far background, sky and horizon; of "
      "these "
      "{} differ visibly (encoded difference above {}), PSNR {:.1f} dB. Enlarged is the part with most of "
      "them: "
      "restoration raises its PSNR from {:.1f} to {:.1f} dB.",
      name_of(study->place.view.position), study->place.searched, restored.pixels, percent(background_share),
      percent(background.visible_share), kVisibleDifference, background.psnr_db,
      study->pictures.box[0].psnr_db, study->pictures.box[1].psnr_db);
  result.differs = background.pixels > 0 && background.visible_share < kFewVisible
                       ? "They agree: where sky belongs, restoration finds the right colour. "
                       : "They differ: even where sky belongs, many restored pixels are visibly wrong. ";
  result.differs += fmt::format(
      "At the other {} of the restored pixels the truth shows leaves, twigs or grass, or restoration does: "
      "that "
      "is the loss of fine structures of figure 33, which the thesis shows apart.",
      percent(1 - background_share));
  return result;
}

}  // namespace plenolab
