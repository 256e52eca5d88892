#include <fmt/format.h>

#include <algorithm>

#include "analysis/statistics.h"
#include "experiments/reproduce/tonemap/suitability_measures.h"
#include "experiments/score.h"

namespace plenolab {

ReproductionResult reproduce_dark_floor(Laboratory& laboratory);

namespace {

/// Half of a straight line's contrast: below that a part is called crushed.
constexpr double kCrushed = 0.5;
/// How far above the best b the picture of "a large b" is taken.
constexpr double kLarger = 2;

struct Outcome {
  SectionOperator chosen;
  std::vector<double> luma_shade, luma_glare, within_shade, within_glare, worse;
};

struct Study {
  std::vector<Outcome> by_brightness;  ///< of brightness_parameters()
  std::vector<Outcome> others;
  int views = 0;
};

void add_numbers(Outcome& outcome, const ShadeAndGlareNumbers& n) {
  outcome.luma_shade.push_back(n.luma_shade);
  outcome.luma_glare.push_back(n.luma_glare);
  outcome.within_shade.push_back(n.within_shade);
  outcome.within_glare.push_back(n.within_glare);
  outcome.worse.push_back(n.worse());
}

Study study_of(SectionScene& scene) {
  Study study;
  for (const double b : brightness_parameters())
    study.by_brightness.push_back({.chosen = reinhard_with_brightness(b)});
  for (SectionOperator& chosen : section_operators())
    if (chosen.choice.info->id != "reinhard05") study.others.push_back({.chosen = std::move(chosen)});
  for (const int i : scene.middle_row()) {
    const SectionView view = scene.view(i);
    const ShadeAndGlare parts = shade_and_glare(view);
    for (std::vector<Outcome>* outcomes : {&study.by_brightness, &study.others})
      for (Outcome& o : *outcomes) add_numbers(o, measure(view, parts, luma_plane(scene.map(o.chosen, i))));
    ++study.views;
  }
  return study;
}

/// Index of the b whose worse part keeps most contrast.
std::size_t best_of(const Study& study) {
  const auto worse = [](const Outcome& a, const Outcome& b) { return median(a.worse) < median(b.worse); };
  return static_cast<std::size_t>(
      std::max_element(study.by_brightness.begin(), study.by_brightness.end(), worse) -
      study.by_brightness.begin());
}

PlotSeries curve(const char* title, const Study& study, std::vector<double> Outcome::*values) {
  PlotSeries series{.title = title};
  const std::vector<double> b = brightness_parameters();
  for (std::size_t i = 0; i < b.size(); ++i)
    series.points.push_back({.x = b[i], .y = median(study.by_brightness[i].*values)});
  return series;
}

ReportPlot brightness_plot(const Study& study) {
  Plot plot;
  plot.x = {.title = "Brightness parameter b"};
  plot.y = {.title = "Luma; contrast relative to a straight line", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 940;
  plot.series = {curve("contrast, floor and ceiling", study, &Outcome::within_shade),
                 curve("contrast, brightest tenth", study, &Outcome::within_glare),
                 curve("luma, floor and ceiling", study, &Outcome::luma_shade),
                 curve("luma, brightest tenth", study, &Outcome::luma_glare)};
  return {
      plot,
      "Naive Reinhard 2005 for all b: what floor and ceiling in the shade and the brightest tenth indoors "
      "are left with (medians over key views of the middle row)",
      "Contrast and luma of two parts of the cellar with light shafts against b"};
}

ReportTable table_of(const Study& study) {
  ReportTable table{
      fmt::format(
          "Medians over {} key views. Contrast of the 10th to 90th percentile: luma per log luminance, 1 "
          "= a straight line from the first to the 99th percentile of the view",
          study.views),
      {"operator", "luma, floor and ceiling", "contrast there", "luma, brightest tenth", "contrast there "},
      {}};
  table.digits = 3;
  for (const std::vector<Outcome>* outcomes : {&study.others, &study.by_brightness})
    for (const Outcome& o : *outcomes)
      table.rows.push_back({o.chosen.label, median(o.luma_shade), median(o.within_shade),
                            median(o.luma_glare), median(o.within_glare)});
  return table;
}

void add_rows(ResultTable& rows, const SectionScene& scene, const Study& study) {
  for (const std::vector<Outcome>* outcomes : {&study.others, &study.by_brightness})
    for (const Outcome& o : *outcomes) {
      const Columns columns{{"scene", scene.id()}, {"operator", o.chosen.label}};
      rows.add({"luma_floor_and_ceiling", median(o.luma_shade), "luma", columns});
      rows.add({"luma_brightest_tenth", median(o.luma_glare), "luma", columns});
      rows.add({"relative_contrast_floor_and_ceiling", median(o.within_shade), "1", columns});
      rows.add({"relative_contrast_brightest_tenth", median(o.within_glare), "1", columns});
    }
}

void add_pictures(ReproductionResult& result, SectionScene& scene, const Study& study) {
  const int middle = scene.middle();
  const SectionView view = scene.view(middle);
  const ShadeAndGlare parts = shade_and_glare(view);
  const double best = brightness_parameters()[best_of(study)];
  ImageComparison comparison{
      fmt::format(
          "{}, key view {}. Parts: floor and ceiling without their brightest quarter, blue; the "
          "brightest tenth of what lies indoors, yellow. b = {:g} keeps most contrast in the worse of them",
          scene.title(), view.name, best),
      "The cellar with light shafts tone mapped with several b and by other operators",
      {}};
  for (const double b : {best - kLarger, best, best + kLarger, best + 2 * kLarger}) {
    if (b < -8 || b > 8) continue;
    const SectionOperator chosen = reinhard_with_brightness(b);
    comparison.images.push_back({chosen.label, scene.map(chosen, middle)});
  }
  for (const Outcome& o : study.others)
    comparison.images.push_back({o.chosen.label, scene.map(o.chosen, middle)});
  const DisplayImage robust = comparison.images.back().image;
  comparison.images.push_back({"Parts", region_map(robust, {{parts.shade.mask, {0.3f, 0.6f, 1}},
                                                            {parts.glare.mask, {1, 0.85f, 0.2f}}})});
  result.add_comparison("cellar-shafts", std::move(comparison));
}

/// "keeps 0.42 of …" of one outcome.
std::string contrasts_of(const Outcome& o) {
  return fmt::format("{:.2f} and {:.2f}", median(o.within_shade), median(o.within_glare));
}

std::string compared_with_thesis(const Study& study) {
  const double b = brightness_parameters()[best_of(study)];
  const Outcome &best = study.by_brightness[best_of(study)], &largest = study.by_brightness.back();
  std::string text =
      median(best.worse) < kCrushed
          ? fmt::format(
                "They agree: no b leaves both parts half the contrast of a straight line; the best, b = "
                "{:g}, leaves {:.2f} in the worse one.",
                b, median(best.worse))
          : fmt::format(
                "They differ: b = {:g} leaves both parts at least half the contrast of a straight line "
                "({:.2f} in the worse one).",
                b, median(best.worse));
  std::size_t keep_more = 0;
  for (const Outcome& o : study.others) keep_more += median(o.worse) > median(best.worse) ? 1 : 0;
  text += fmt::format(" {} of the {} other operators keep more in their worse part.", keep_more,
                      study.others.size());
  if (median(largest.luma_shade) > 0.5)
    text += fmt::format(
        " A large b brightens floor and ceiling here, to luma {:.2f} at b = {:g}, and takes their contrast "
        "({:.2f}).",
        median(largest.luma_shade), brightness_parameters().back(), median(largest.within_shade));
  return text +
         " Which b is large depends on the unit of the radiance, here cd/m², so all that the operator "
         "takes are tried.";
}

void describe(ReproductionResult& result, const Study& study) {
  const double b = brightness_parameters()[best_of(study)];
  const Outcome& best = study.by_brightness[best_of(study)];
  result.ours_shows = fmt::format(
      "Of the contrast a straight line in log luminance would give, naive Reinhard 2005 at its best b = {:g} "
      "keeps {} on floor and ceiling in the shade and in the brightest tenth indoors (medians of {} key "
      "views), "
      "with floor and ceiling at luma {:.2f}; at b = {:g} it keeps {}, at b = {:g} {}. ",
      b, contrasts_of(best), study.views, median(best.luma_shade), brightness_parameters().front(),
      contrasts_of(study.by_brightness.front()), brightness_parameters().back(),
      contrasts_of(study.by_brightness.back()));
  for (const Outcome& o : study.others)
    result.ours_shows +=
        fmt::format("{}: {} (luma {:.2f}). ", o.chosen.label, contrasts_of(o), median(o.luma_shade));
  result.differs = compared_with_thesis(study);
}

}  // namespace

ReproductionResult reproduce_dark_floor(Laboratory& laboratory) {
  SectionScene scene(laboratory, "cellar-shafts");
  const Study study = study_of(scene);
  ReproductionResult result;
  result.paper_shows =
      "Figure 47: in the Cellar with volumetric light, naive Reinhard 2005 leaves floor and ceiling without "
      "brightness and contrast even for large brightness parameters b, which compress the bright regions and "
      "mask textures near the window.";
  add_rows(result.rows, scene, study);
  describe(result, study);
  add_pictures(result, scene, study);
  result.add_plot("contrast-over-brightness", brightness_plot(study));
  result.add_table(table_of(study));
  return result;
}

}  // namespace plenolab
