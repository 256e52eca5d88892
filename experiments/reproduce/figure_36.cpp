#include <fmt/format.h>

#include "experiments/reproduce/figure_appearance.h"

namespace plenolab {

ReproductionResult reproduce_water(Laboratory& laboratory);

ReproductionResult reproduce_water(Laboratory& laboratory) {
  constexpr double kFewVisible = 0.1;  // share of visibly wrong pixels that still counts as a success
  constexpr double kNotableDifference_db = 1;
  ReproductionResult result;
  const AppearanceStudy study = study_appearance(result, laboratory,
                                                 {.scene = "boats",
                                                  .offsets = offsets_inside_cells().first(1),
                                                  .with_epi = false,
                                                  .with_sparser_grid = true});
  const ErrorNumbers &inside = study.pictures.box[0], &whole = study.pictures.whole[0];
  const bool success = inside.visible_share < kFewVisible;
  result.paper_shows =
      "Figure 36 shows the water of Boats and Lanterns: although it mirrors the lanterns, ripples and the "
      "denser grid of key views leave only slightly blurred outlines of reflections, not noticeable without "
      "the truth beside them.";
  result.ours_shows = fmt::format(
      "View from {}, the centre of the cell, of {}, where key views disagree most within one crop; enlarged "
      "is the part with the largest error among pixels that all key views see. "
      "PSNR {:.1f} dB "
      "and SSIM "
      "{:.3f} there, {:.1f} dB and {:.3f} in the whole view; {} of the enlarged pixels differ visibly "
      "(encoded difference above {}).",
      name_of(study.place.view.position), study.place.searched, inside.psnr_db, inside.ssim, whole.psnr_db,
      whole.ssim, percent(inside.visible_share), kVisibleDifference);
  if (study.pictures.box.size() > 1) {
    const double gain_db = inside.psnr_db - study.pictures.box[1].psnr_db;
    result.ours_shows += fmt::format(
        " From every other key view, at twice the spacing, the PSNR of the same part is {:.1f} dB and {} of "
        "its pixels differ visibly: {}.",
        study.pictures.box[1].psnr_db, percent(study.pictures.box[1].visible_share),
        gain_db > kNotableDifference_db ? "the denser grid is better there, as the thesis says"
                                        : fmt::format("a difference of {:.1f} dB, less than {:g} dB, says "
                                                      "nothing about the density of the grid",
                                                      gain_db, kNotableDifference_db));
  }
  result.differs =
      success
          ? "They agree: even the part with the largest error is close to the truth."
          : "They differ in degree: the part with the largest error differs visibly beside the truth. The "
            "thesis shows a part of its choice and judges by eye.";
  return result;
}

}  // namespace plenolab
