#include "experiments/reproduce/figure_appearance.h"

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/lightfield/subsample.h"
#include "core/synthesis/visibility_map.h"

namespace plenolab {

namespace {

constexpr int kSparserStride = 2;
constexpr int kSmoothingRadius = 4;  // of errors by which the enlarged part is chosen

/// The view from the same place, from every other key view only; nothing if the position is not between them.
std::optional<NovelView<SceneReferred>> from_sparser_grid(const LightField& field, CameraPosition position,
                                                          int threads) {
  const LightField sparser = subsample(field, kSparserStride);
  const auto scaled = [](double value, int views) { return views > 1 ? value / kSparserStride : value; };
  const CameraPosition there{scaled(position.s, field.grid().columns), scaled(position.t, field.grid().rows)};
  if (!sparser.grid().contains(there)) return std::nullopt;
  SynthesisOptions options;
  options.threads = threads;
  return synthesize(sparser, there, options);
}

/// Error of the pixels whose surface every key view sees: it comes from appearance, not from geometry.
Plane<float> appearance_error(const NovelView<SceneReferred>& view, const SceneImage& truth, bool coherent) {
  const auto difference = coherent ? coherent_squared_difference : smoothed_squared_difference;
  Plane<float> error = difference(view.image, truth, figure_exposure(truth), kSmoothingRadius);
  for (std::size_t n = 0; n < error.size(); ++n)
    if (view.visible_views.pixels()[n] < view.views.size()) error.pixels()[n] = 0;
  return error;
}

double mean_inside(const Plane<float>& values, const PixelBox& box) {
  double sum = 0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) sum += static_cast<double>(values.at(x, y));
  return sum / (box.width * box.height);
}

/// Root of mean error inside the box over mean error outside of it.
double concentration(const Plane<float>& error, const PixelBox& box) {
  const double pixels = static_cast<double>(error.size()), inside_pixels = box.width * box.height;
  const PixelBox all{0, 0, error.width(), error.height()};
  const double inside = mean_inside(error, box);
  const double outside = mean_inside(error, all) * pixels - inside * inside_pixels;
  return outside <= 0 ? 0 : std::sqrt(inside / (outside / (pixels - inside_pixels)));
}

/// Moves the box of the place to the part worth enlarging; returns the row for the epipolar image.
int choose_part(Place& place, const SceneImage& truth, const AppearanceOptions& options) {
  if (options.at_borders) return densest_row(place.effect, place.box);
  const Plane<float> error = appearance_error(place.view, truth, options.coherent);
  place.box = densest_box(error, place.box.width);
  return densest_row(error, place.box);
}

void add_views(ReproductionResult& result, AppearanceStudy& study, const LightField& field,
               const SceneImage& truth, int row, const AppearanceOptions& options, const std::string& what,
               const Columns& columns, int threads) {
  const NovelView<SceneReferred>& view = study.place.view;
  const auto sparser = options.with_sparser_grid ? from_sparser_grid(field, view.position, threads)
                                                 : std::optional<NovelView<SceneReferred>>();
  FigurePictures pictures{.what = what,
                          .truth = &truth,
                          .synthesised = {{"Synthesised", &view.image}},
                          .maps = {{"Visibility", visibility_map(view)}},
                          .box = study.place.box,
                          .cut_row = options.with_epi ? std::optional<int>(row) : std::nullopt};
  if (sparser) pictures.synthesised.push_back({"From every other key view", &sparser->image});
  study.pictures = add_pictures(result, pictures, columns, threads);
}

}  // namespace

AppearanceStudy study_appearance(ReproductionResult& result, Laboratory& laboratory,
                                 const AppearanceOptions& options) {
  const int threads = laboratory.options().threads;
  const LightField field = laboratory.light_field(options.scene);
  AppearanceStudy study;
  study.place = find_place(
      laboratory.synthesizer(options.scene), cell_positions(field.grid(), options.offsets), threads,
      options.at_borders ? jump_at_visibility_borders(field) : disagreement_of_views(field));
  const NovelView<SceneReferred>& view = study.place.view;
  const auto rendered = laboratory.truth(options.scene, view.position, kTruthPathFactor);
  const SceneImage& truth = rendered.colour;
  const int row = choose_part(study.place, truth, options);
  const PixelBox& box = study.place.box;
  study.rms_disagreement = std::sqrt(mean_inside(study.place.effect, box));
  study.error_concentration =
      concentration(smoothed_squared_difference(view.image, truth, figure_exposure(truth)), box);

  const std::string what = laboratory.scene(options.scene).title + " from " + name_of(view.position);
  const Columns columns{{"scene", options.scene}, {"position", name_of(view.position)}};
  add_views(result, study, field, truth, row, options, what, columns, threads);
  if (options.with_epi) {
    const auto disparity_px = static_cast<double>(rendered.disparity.at(box.x + box.width / 2, row));
    study.epi = add_epi(result, record_epi(laboratory, options.scene, view.position, row), box,
                        crop_exposure(truth, box), disparity_px, what, columns);
  }
  result.rows.add({"rms_disagreement", study.rms_disagreement, "1", columns});
  result.rows.add({"error_concentration", study.error_concentration, "1", columns});
  return study;
}

}  // namespace plenolab
