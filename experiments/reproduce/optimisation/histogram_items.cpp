// Figures 5 and 6, and claim Z-1: how spiky histograms of luminance are.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/reproduce/optimisation/luminance_histograms.h"
#include "experiments/reproduce/optimisation/tuning_tools.h"

namespace plenolab {

ReproductionResult reproduce_natural_histograms(Laboratory& laboratory);
ReproductionResult reproduce_game_histograms(Laboratory& laboratory);
ReproductionResult reproduce_claim_z1(Laboratory& laboratory);

namespace {

using ShapeValue = double HistogramShape::*;

std::vector<double> values_of(const std::vector<HistogramSource>& images, ShapeValue value) {
  std::vector<double> values;
  for (const HistogramSource& source : images) values.push_back(source.shape.*value);
  return values;
}

std::string range_text(const std::vector<HistogramSource>& images, ShapeValue value) {
  const std::vector<double> v = values_of(images, value);
  return fmt::format("{:.0f} % ({:.0f} to {:.0f} %)", 100 * mean(v),
                     100 * *std::min_element(v.begin(), v.end()),
                     100 * *std::max_element(v.begin(), v.end()));
}

std::string shape_sentence(const std::vector<HistogramSource>& images) {
  return fmt::format(
      "The fullest tenth of the bins holds {} of the pixels, and {} would have to change bin for a smooth "
      "histogram (mean, and range over {} images).",
      range_text(images, &HistogramShape::concentration), range_text(images, &HistogramShape::jaggedness),
      images.size());
}

std::string natural_text(const std::vector<HistogramSource>& images) {
  const std::size_t photographs = photographs_in(images);
  const std::string stand_ins = fmt::format(
      "middle views of {} of our path-traced scenes, which have scattered light, soft shadows and rich "
      "textures as photographs have but are rendered themselves",
      images.size() - photographs);
  if (photographs == 0)
    return fmt::format("No photograph was at hand (PLENOLAB_OUTSIDE_DATA): their places are taken by {}.",
                       stand_ins);
  return fmt::format("Of photographs {} was at hand; the other places are taken by {}.", photographs,
                     stand_ins);
}

/// Files the verdict on a measure, game-like less natural.
Outcome conclude_shape(ReproductionResult& result, const std::vector<HistogramSource>& games,
                       const std::vector<HistogramSource>& natural, ShapeValue value, Claim claim,
                       const std::string& quantity, const std::string& note) {
  Verdict verdict = decide_spikiness(games, natural, value, quantity);
  if (photographs_in(natural) > 0) verdict.explanation += " " + note;
  const Outcome outcome = verdict.outcome;
  conclude(result, std::move(claim), std::move(verdict));
  return outcome;
}

Plot shape_plot(const std::vector<HistogramSource>& natural, const std::vector<HistogramSource>& games) {
  Plot plot;
  plot.x = {.title = "Pixels in the fullest tenth of the bins", .unit = "%"};
  plot.y = {.title = "Pixels to move for a smooth histogram", .unit = "%"};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  const auto add = [&](const char* title, const std::vector<HistogramSource>& images, bool photographs) {
    PlotSeries series{title, PlotSeries::Style::kPoints, {}};
    for (const HistogramSource& s : images)
      if (s.photograph == photographs)
        series.points.push_back({.x = 100 * s.shape.concentration, .y = 100 * s.shape.jaggedness});
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  };
  add("photographs", natural, true);
  add("path-traced scenes", natural, false);
  add("game-like frames", games, false);
  return plot;
}

}  // namespace

ReproductionResult reproduce_natural_histograms(Laboratory& laboratory) {
  ReproductionResult result;
  const std::vector<HistogramSource> images = natural_images(laboratory);
  add_histograms(result, images, "natural",
                 photographs_in(images) > 0 ? "Photographs and scenes in their place"
                                            : "Path-traced scenes in the place of photographs");
  result.paper_shows =
      "Figure 5: natural HDR images of the database TMIQD, tone mapped by Reinhard's operator, and their "
      "histograms of log luminance, which are not spiky.";
  result.ours_shows = shape_sentence(images);
  result.differs = natural_text(images);
  return result;
}

ReproductionResult reproduce_game_histograms(Laboratory& laboratory) {
  ReproductionResult result;
  const std::vector<HistogramSource> images = game_images(laboratory);
  add_histograms(result, images, "game-like", "Game-like frames, one of each sequence");
  result.paper_shows =
      "Figure 6: synthetic HDR images of the same database; several histograms (S3, S4, S7, S8) are spiky: "
      "luminances are concentrated in small areas.";
  result.ours_shows = shape_sentence(images);
  result.differs =
      "Ours are frames of the ten game-like sequences, drawn in the way of games: large surfaces of one "
      "material under analytic lights and even ambient light. They have less texture than games of today "
      "have.";
  return result;
}

ReproductionResult reproduce_claim_z1(Laboratory& laboratory) {
  ReproductionResult result;
  const std::vector<HistogramSource> natural = natural_images(laboratory), games = game_images(laboratory);
  const std::string note = natural_text(natural);
  const Outcome concentrated = conclude_shape(
      result, games, natural, &HistogramShape::concentration,
      {"Z-1a", tuning_thesis("section 2.2.1"),
       "Luminances of rendered game content are concentrated in smaller parts of the histogram than those of "
       "photographs."},
      "concentration_difference", note);
  const Outcome jagged =
      conclude_shape(result, games, natural, &HistogramShape::jaggedness,
                     {"Z-1b", tuning_thesis("section 2.2.1"),
                      "Histograms of rendered game content are more jagged than those of photographs."},
                     "jaggedness_difference", note);
  result.add_plot("spikiness", {shape_plot(natural, games), "Two measures of spikiness, one point an image",
                                "Concentration and jaggedness of luminance histograms."});
  result.paper_shows =
      "Section 2.2.1: histograms of rendered HDR content are spikier than those of photographs; luminances "
      "are concentrated in smaller areas and not spread over the whole range.";
  result.ours_shows =
      fmt::format("Game-like frames: {} Others: {}", shape_sentence(games), shape_sentence(natural));
  result.differs = fmt::format(
      "Concentration: {}; jaggedness: {}.{} {} Game-like frames were made to look like what the thesis "
      "describes, so that the verdict says what that way of drawing does, not how all games look.",
      outcome_name(concentrated), outcome_name(jagged),
      photographs_in(natural) > 0 ? ""
                                  : " Rendered against rendered does not decide a claim about photographs.",
      note);
  return result;
}

}  // namespace plenolab
