#include <fmt/format.h>

#include "experiments/reproduce/figure_restoration.h"

namespace plenolab {

ReproductionResult reproduce_restored_sky(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "tree";
constexpr double kFewFailures = 0.2;  // share of wrong pixels that still counts as a success

std::string place_sentence(const RestorationStudy& study) {
  return fmt::format(
      "From {}, of {} positions the one with most restored pixels in one crop, {} pixels are seen by no key "
      "view and restored.",
      name_of(study.place.view.position), study.place.searched, study.restored->pixels);
}

std::string sky_sentence(const RestorationStudy& study, double background_share) {
  return fmt::format(
      " At {} of them the truth shows the far background (disparity of at most {:g} px). Of these, "
      "restoration shows something nearer at {}; at these and wherever the colour differs visibly (encoded "
      "difference above {}) it fails, together {}. PSNR of all pixels before far background: {:.1f} dB. The "
      "part with most of them is enlarged; its PSNR is {:.1f} dB before and {:.1f} dB after restoration.",
      percent(background_share), kFarBackground_px, percent(study.background_nearer_share),
      kVisibleDifference, percent(study.background_failed_share), study.background->psnr_db,
      study.pictures.box[0].psnr_db, study.pictures.box[1].psnr_db);
}

std::string difference_sentence(const RestorationStudy& study, double background_share) {
  const double failed = study.background_failed_share;
  const std::string sky =
      failed < kFewFailures
          ? fmt::format("They agree: restoration is right at {} of the pixels where sky belongs.",
                        percent(1 - failed))
          : fmt::format(
                "They differ: restoration fails at {} of the pixels where sky belongs, {}.", percent(failed),
                study.background_nearer_share > failed / 2
                    ? "mostly because it takes something nearer from the neighbouring pixels for background"
                    : "mostly by a wrong colour at the right distance");
  return sky + fmt::format(
                   " At the other {} of the restored pixels the truth shows something nearer than the far "
                   "background, which this figure is not about.",
                   percent(1 - background_share));
}

}  // namespace

ReproductionResult reproduce_restored_sky(Laboratory& laboratory) {
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
  result.ours_shows = place_sentence(*study);
  if (!study->background) {
    result.ours_shows +=
        fmt::format(" At none of them does the truth show the far background (disparity of at most {:g} px).",
                    kFarBackground_px);
    result.differs = "Nothing can be compared: no sky had to be restored in this run.";
    return result;
  }
  const double background_share =
      static_cast<double>(study->background->pixels) / static_cast<double>(study->restored->pixels);
  result.ours_shows += sky_sentence(*study, background_share);
  result.differs = difference_sentence(*study, background_share);
  return result;
}

}  // namespace plenolab
