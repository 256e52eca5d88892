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

Mask restored_background(const NovelView<SceneReferred>& view, const DisparityMap& truth) {
  Mask mask = view.restored;
  for (std::size_t n = 0; n < mask.size(); ++n)
    if (std::max(truth.pixels()[n], nearest_shown(view.provenance.pixels()[n])) > 1) mask.pixels()[n] = 0;
  return mask;
}

Plane<float> error_of_effect(const Place& place, const SceneImage& truth) {
  Plane<float> error = smoothed_squared_difference(place.view.image, truth, figure_exposure(truth));
  for (std::size_t n = 0; n < error.size(); ++n)
    if (place.effect.pixels()[n] <= 0) error.pixels()[n] = 0;
  return error;
}

}  // namespace

std::optional<RestorationStudy> study_restoration(ReproductionResult& result, Laboratory& laboratory,
                                                  const std::string& scene, const EffectMeasure& measure,
                                                  const std::string& region, RestorationCrop enlarged) {
  const int threads = laboratory.options().threads;
  const Synthesizer& synthesizer = laboratory.synthesizer(scene);
  RestorationStudy study;
  study.place = find_place(synthesizer, cell_positions(laboratory.grid(scene), offsets_inside_cells()),
                           threads, measure);
  if (study.place.sum <= 0) return std::nullopt;
  const NovelView<SceneReferred>& after = study.place.view;
  SynthesisOptions without;
  without.restore = false;
  without.threads = threads;
  const auto before = synthesizer.synthesize(after.position, without);
  const auto truth = laboratory.truth(scene, after.position, kTruthPathFactor);
  const Mask background = restored_background(after, truth.disparity);
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
  const auto numbers_of = [&](const Mask& mask, const std::string& name) {
    return add_masked_rows(result, after.image, truth.colour, mask, name, columns);
  };
  study.effect = numbers_of(mask_of(study.place.effect), region);
  study.restored = numbers_of(after.restored, "restored");
  study.others = numbers_of(inverse(after.restored), "not restored");
  study.background = numbers_of(background, "restored, far background in truth");
  result.rows.add({"unseen_pixels", static_cast<double>(after.unseen_pixels), "px", columns});
  return study;
}

}  // namespace plenolab
