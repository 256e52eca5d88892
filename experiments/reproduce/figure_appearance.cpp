#include "experiments/reproduce/figure_appearance.h"

#include <fmt/format.h>

#include <cmath>

#include "core/lightfield/subsample.h"
#include "core/synthesis/visibility_map.h"

namespace plenolab {

namespace {

constexpr int kSparserStride = 2;

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

/// Errors beside borders of visibility, where the effect is above 0, and elsewhere in the box.
BorderErrors border_errors(const Place& place, const SceneImage& truth) {
  const Plane<float> error =
      smoothed_squared_difference(place.view.image, truth, figure_exposure(truth), /*radius=*/1);
  Plane<float> border(error.width(), error.height());
  for (std::size_t n = 0; n < border.size(); ++n) border.pixels()[n] = place.effect.pixels()[n] > 0 ? 1 : 0;
  const Plane<float> near = box_mean(border, kBesideBorder_px);
  double sums[2] = {0, 0}, counts[2] = {0, 0};
  for (int y = place.box.y; y < place.box.y + place.box.height; ++y)
    for (int x = place.box.x; x < place.box.x + place.box.width; ++x) {
      const int beside = near.at(x, y) > 0 ? 1 : 0;
      sums[beside] += static_cast<double>(error.at(x, y));
      counts[beside] += 1;
    }
  const auto rms = [&](int i) { return counts[i] > 0 ? std::sqrt(sums[i] / counts[i]) : 0.0; };
  return {.beside = rms(1), .elsewhere = rms(0)};
}

/// How position and enlarged part are chosen, exactly.
std::string choice_text(const Place& place, const AppearanceOptions& options) {
  const bool on_row = place.view.position.t == std::round(place.view.position.t);
  const std::string effect =
      options.at_borders ? "ceasing of key views at borders of visibility changes the blend most (squared "
                           "change of luma at pixels beside borders on one surface)"
                         : "key views disagree most (weighted variance of luma, smoothed over 5 × 5 px)";
  return fmt::format(
      "The position is, of {} {}, the one where {} within a square of {} px, found without the truth. "
      "Enlarged is that square itself.",
      place.searched, on_row ? "midway between two key views of a row" : "at the centres of cells", effect,
      place.box.width);
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
                          .cut_row = options.with_epi ? std::optional<int>(row) : std::nullopt,
                          .choice = study.choice,
                          .note = options.seen};
  if (sparser) pictures.synthesised.push_back({"From every other key view", &sparser->image});
  study.pictures = add_pictures(result, pictures, columns, threads);
}

}  // namespace

std::string elsewhere_text(const AppearanceStudy& study) {
  if (!study.overview.fading) return "";
  return fmt::format(
      "In the image's middle row the error between key views is more than {:g} times that at them at {} of "
      "the places.",
      kFadingRatio, study.overview.fading->median > kFadingRatio ? "at least half" : "fewer than half");
}

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
  const int row = densest_row(study.place.effect, study.place.box);
  study.choice = choice_text(study.place, options);
  const PixelBox& box = study.place.box;
  study.rms_disagreement = std::sqrt(mean_inside(study.place.effect, box));
  study.error_concentration =
      concentration(smoothed_squared_difference(view.image, truth, figure_exposure(truth)), box);

  const std::string what = laboratory.scene(options.scene).title + " from " + name_of(view.position);
  const Columns columns{{"scene", options.scene}, {"position", name_of(view.position)}};
  add_views(result, study, field, truth, row, options, what, columns, threads);
  if (options.at_borders) {
    study.borders = border_errors(study.place, truth);
    result.rows.add({"rms_beside_borders", study.borders->beside, "1", columns});
    result.rows.add({"rms_elsewhere", study.borders->elsewhere, "1", columns});
  }
  std::optional<EpiPair> middle;
  if (options.with_epi) {
    const auto disparity_px = static_cast<double>(rendered.disparity.at(box.x + box.width / 2, row));
    study.epi = add_epi(result, record_epi(laboratory, options.scene, view.position, row), box,
                        crop_exposure(truth, box), disparity_px, what, columns);
    middle = record_epi(laboratory, options.scene, view.position, truth.height() / 2);
  }
  study.overview = overview_of(view, truth, box, middle ? &*middle : nullptr);
  add_overview_rows(result.rows, study.overview, columns);
  result.rows.add({"rms_disagreement", study.rms_disagreement, "1", columns});
  result.rows.add({"error_concentration", study.error_concentration, "1", columns});
  return study;
}

}  // namespace plenolab
