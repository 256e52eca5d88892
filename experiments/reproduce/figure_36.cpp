#include <fmt/format.h>

#include "experiments/reproduce/figure_appearance.h"

namespace plenolab {

ReproductionResult reproduce_water(Laboratory& laboratory);

namespace {

constexpr double kFewVisible = 0.1;  // share of visibly wrong pixels that still counts as a success
constexpr double kNotableDifference_db = 1;

/// What every other key view leaves of the same part; empty if the position does not allow it.
std::string sparser_sentence(const PictureNumbers& pictures) {
  if (pictures.box.size() < 2) return "";
  const ErrorNumbers &dense = pictures.box[0], &sparse = pictures.box[1];
  const double gain_db = dense.psnr_db - sparse.psnr_db;
  return fmt::format(
      " From every other key view, at twice the spacing, the PSNR of the same part is {:.1f} dB and {} of "
      "its pixels differ visibly: {}.",
      sparse.psnr_db, percent(sparse.visible_share),
      gain_db > kNotableDifference_db
          ? "the denser grid is better there, as the thesis says"
          : fmt::format("a difference of {:.1f} dB, less than {:g} dB, says nothing about the density of the "
                        "grid",
                        gain_db, kNotableDifference_db));
}

}  // namespace

ReproductionResult reproduce_water(Laboratory& laboratory) {
  ReproductionResult result;
  const AppearanceStudy study = study_appearance(result, laboratory,
                                                 {.scene = "boats",
                                                  .seen = "Seen: reflections on rippled water.",
                                                  .offsets = offsets_inside_cells().first(1),
                                                  .with_epi = false,
                                                  .with_sparser_grid = true});
  const ErrorNumbers &inside = study.pictures.box[0], &whole = study.pictures.whole[0];
  result.paper_shows =
      "Figure 36 shows the water of Boats and Lanterns: although it mirrors the lanterns, ripples and the "
      "denser grid of key views leave only slightly blurred outlines of reflections, not noticeable without "
      "the truth beside them.";
  result.ours_shows = fmt::format(
      "View from {}. {} PSNR {:.1f} dB and SSIM {:.3f} there, {:.1f} dB and {:.3f} in the whole view; {} of "
      "the enlarged pixels differ visibly (encoded difference above {}).{} {}",
      name_of(study.place.view.position), study.choice, inside.psnr_db, inside.ssim, whole.psnr_db,
      whole.ssim, percent(inside.visible_share), kVisibleDifference, sparser_sentence(study.pictures),
      overview_text(study.overview));
  result.differs =
      inside.visible_share < kFewVisible
          ? "They agree: even where the key views disagree most the synthesis is close to the truth."
          : "They differ in degree: where the key views disagree most the synthesis differs visibly from the "
            "truth. The thesis shows a part of its choice and judges by eye.";
  return result;
}

}  // namespace plenolab
