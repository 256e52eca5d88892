#include "experiments/reproduce/figure_restoration.h"

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/synthesis/visibility_map.h"

namespace plenolab {

namespace {

Mask mask_of(const Plane<float>& weights) {
  Mask mask(weights.width(), weights.height());
  for (std::size_t n = 0; n < mask.size(); ++n) mask.pixels()[n] = weights.pixels()[n] > 0;
  return mask;
}

Mask inverse(Mask mask) {
  for (unsigned char& set : mask.pixels()) set = set == 0;
  return mask;
}

float nearest_shown(const PixelProvenance& provenance) {
  float disparity = 0;
  for (const Correspondence& c : provenance)
    if (c.weight > 0) disparity = std::max(disparity, c.disparity_px);
  return disparity;
}

Plane<float> error_of_effect(const Place& place, const SceneImage& truth) {
  Plane<float> error = smoothed_squared_difference(place.view.image, truth, figure_exposure(truth));
  for (std::size_t n = 0; n < error.size(); ++n)
    if (place.effect.pixels()[n] <= 0) error.pixels()[n] = 0;
  return error;
}

/// Numbers of the restored pixels before far background, and how many of them fail.
void add_background(RestorationStudy& study, ReproductionResult& result, const SceneImage& truth,
                    const Mask& background, const Columns& columns) {
  const NovelView<SceneReferred>& view = study.place.view;
  study.background =
      add_masked_rows(result, view.image, truth, background, "restored, far background in truth", columns);
  if (!study.background) return;
  Mask right_depth = background;
  for (std::size_t n = 0; n < right_depth.size(); ++n)
    if (nearest_shown(view.provenance.pixels()[n]) > kFarBackground_px) right_depth.pixels()[n] = 0;
  const auto far = add_masked_rows(result, view.image, truth, right_depth,
                                   "restored, far background in truth and restoration", columns);
  const auto all = static_cast<double>(study.background->pixels);
  const double far_share = static_cast<double>(count_set(right_depth)) / all;
  study.background_nearer_share = 1 - far_share;
  study.background_failed_share = 1 - far_share + (far ? far->visible_share * far_share : 0.0);
  result.rows.add({"nearer_share", study.background_nearer_share, "1", columns});
  result.rows.add({"failed_share", study.background_failed_share, "1", columns});
}

/// The true view and the view before restoration at the place of the study.
struct Compared {
  NovelView<SceneReferred> before;
  KeyView<SceneReferred> truth;
};

Compared views_at(Laboratory& laboratory, const std::string& scene, CameraPosition position) {
  SynthesisOptions without;
  without.restore = false;
  without.threads = laboratory.options().threads;
  return {laboratory.synthesizer(scene).synthesize(position, without),
          laboratory.truth(scene, position, kTruthPathFactor)};
}

}  // namespace

Mask restored_before_background(const Mask& restored, const DisparityMap& truth) {
  Mask mask = restored;
  for (std::size_t n = 0; n < mask.size(); ++n)
    if (truth.pixels()[n] > kFarBackground_px) mask.pixels()[n] = 0;
  return mask;
}

std::optional<RestorationStudy> study_restoration(ReproductionResult& result, Laboratory& laboratory,
                                                  const std::string& scene, const EffectMeasure& measure,
                                                  const std::string& region, RestorationCrop enlarged) {
  const int threads = laboratory.options().threads;
  RestorationStudy study;
  study.place = find_place(laboratory.synthesizer(scene),
                           cell_positions(laboratory.grid(scene), offsets_inside_cells()), threads, measure);
  if (study.place.sum <= 0) return std::nullopt;
  const NovelView<SceneReferred>& after = study.place.view;
  const auto [before, truth] = views_at(laboratory, scene, after.position);
  const Mask background = restored_before_background(after.restored, truth.disparity);
  study.place.box =
      densest_box(enlarged == RestorationCrop::kWorst ? error_of_effect(study.place, truth.colour)
                                                      : as_weights(background),
                  study.place.box.width);

  const Columns columns{{"scene", scene}, {"position", name_of(after.position)}};
  study.pictures = add_pictures(
      result,
      {.what = laboratory.scene(scene).title + " from " + name_of(after.position),
       .truth = &truth.colour,
       .synthesised = {{"Before restoration", &before.image}, {"After restoration", &after.image}},
       .maps = {{"Visibility", visibility_map(after)}},
       .box = study.place.box,
       .cut_row = {}},
      columns, threads);
  const auto add_numbers = [&, &colour = truth.colour](const Mask& mask, const std::string& name) {
    return add_masked_rows(result, after.image, colour, mask, name, columns);
  };
  study.effect = add_numbers(mask_of(study.place.effect), region);
  study.restored = add_numbers(after.restored, "restored");
  study.others = add_numbers(inverse(after.restored), "not restored");
  add_background(study, result, truth.colour, background, columns);
  result.rows.add({"unseen_pixels", static_cast<double>(after.unseen_pixels), "px", columns});
  return study;
}

}  // namespace plenolab
