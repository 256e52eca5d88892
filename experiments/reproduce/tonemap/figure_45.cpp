#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/tonemap/suitability_measures.h"

namespace plenolab {

ReproductionResult reproduce_flattened_outdoors(Laboratory& laboratory);

namespace {

/// Histogram adjustment is first; the operators of the section follow, then other ceilings.
std::vector<SectionOperator> operators_compared() {
  std::vector<SectionOperator> all = section_operators();
  all.push_back(section_operator("Histogram, linear ceiling", "histogram", "naive", {"ceiling=linear"}));
  all.push_back(
      section_operator("Histogram, ceiling as printed", "histogram", "naive", {"ceiling=as-printed"}));
  all.push_back(section_operator("Histogram, no ceiling", "histogram", "naive", {"passes=0"}));
  return all;
}

/// An operator over all key views.
struct Outcome {
  SectionOperator chosen;
  std::vector<double> between, within_indoors, within_outdoors, luma_indoors, luma_outdoors;
  DisplayImage middle;
};

struct Study {
  std::vector<Outcome> outcomes;
  std::vector<double> scene_between;  ///< log10, of each key view that shows both
};

void add_view(SectionScene& scene, int index, Study& study) {
  const SectionView view = scene.view(index);
  const IndoorsOutdoors parts = indoors_and_outdoors(view);
  if (count_set(parts.outdoors.mask) == 0 || count_set(parts.indoors.mask) == 0) return;
  study.scene_between.push_back(parts.log_between());
  for (Outcome& o : study.outcomes) {
    DisplayImage mapped = scene.map(o.chosen, index);
    const IndoorsOutdoorsNumbers n = measure(view, parts, luma_plane(mapped));
    o.between.push_back(n.between);
    o.within_indoors.push_back(n.within_indoors);
    o.within_outdoors.push_back(n.within_outdoors);
    o.luma_indoors.push_back(n.luma_indoors);
    o.luma_outdoors.push_back(n.luma_outdoors);
    if (index == scene.middle()) o.middle = std::move(mapped);
  }
}

ReportTable table_of(const Study& study) {
  ReportTable table{
      fmt::format(
          "Medians over the {} key views of the middle row. Contrast: luma per log luminance, 1 = a straight "
          "line from the first to the 99th percentile of the view",
          study.scene_between.size()),
      {"operator", "luma indoors", "luma outdoors", "contrast between", "within indoors", "within outdoors"},
      {}};
  table.digits = 3;
  for (const Outcome& o : study.outcomes)
    table.rows.push_back({o.chosen.label, median(o.luma_indoors), median(o.luma_outdoors), median(o.between),
                          median(o.within_indoors), median(o.within_outdoors)});
  return table;
}

PlotSeries bars(const char* title, const std::vector<Outcome>& outcomes,
                std::vector<double> Outcome::*values) {
  PlotSeries series{.title = title};
  for (const Outcome& o : outcomes) {
    const auto [low, high] = std::minmax_element((o.*values).begin(), (o.*values).end());
    series.points.push_back({.y = median(o.*values), .y_low = *low, .y_high = *high});
  }
  return series;
}

ReportPlot contrast_plot(const Study& study) {
  Plot plot;
  plot.y = {.title = "Contrast relative to a straight line", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  for (const Outcome& o : study.outcomes) plot.categories.push_back(o.chosen.label);
  plot.series = {bars("between indoors and outdoors", study.outcomes, &Outcome::between),
                 bars("within indoors", study.outcomes, &Outcome::within_indoors),
                 bars("within outdoors", study.outcomes, &Outcome::within_outdoors)};
  plot.width_px = 980;
  return {plot,
          "Contrast that operators keep between and within the parts. Bars: medians over key views of the "
          "middle row, with "
          "their extremes",
          "Contrasts between and within indoors and outdoors for operators and ceilings"};
}

void add_rows(ResultTable& rows, const SectionScene& scene, const Study& study) {
  for (const Outcome& o : study.outcomes) {
    const Columns columns{{"scene", scene.id()}, {"operator", o.chosen.label}};
    rows.add({"relative_contrast_between", median(o.between), "1", columns});
    rows.add({"relative_contrast_indoors", median(o.within_indoors), "1", columns});
    rows.add({"relative_contrast_outdoors", median(o.within_outdoors), "1", columns});
    rows.add({"luma_indoors", median(o.luma_indoors), "luma", columns});
    rows.add({"luma_outdoors", median(o.luma_outdoors), "luma", columns});
  }
  rows.add({"scene_contrast_between", median(study.scene_between), "log10", {{"scene", scene.id()}}});
}

void add_pictures(ReproductionResult& result, SectionScene& scene, const Study& study) {
  const SectionView view = scene.view(scene.middle());
  const IndoorsOutdoors parts = indoors_and_outdoors(view);
  ImageComparison comparison{
      fmt::format("{}, key view {}. Parts: what lies deeper than the far wall (8 m) is outdoors, green",
                  scene.title(), view.name),
      "The cellar tone mapped by several operators, and the part that is outdoors",
      {}};
  for (const Outcome& o : study.outcomes) comparison.images.push_back({o.chosen.label, o.middle});
  comparison.images.push_back(
      {"Parts", region_map(study.outcomes.front().middle, {{parts.outdoors.mask, {0.2f, 1, 0.2f}}})});
  result.add_comparison("cellar", std::move(comparison));
}

/// Whether the contrast shrinks as the thesis says, and where else it does.
std::string compared_with_thesis(const Study& study) {
  const double kept = median(study.outcomes[0].between);
  std::string text =
      kept < 0.5
          ? fmt::format("They agree: contrast between indoors and outdoors shrinks to {} of its share.",
                        percent(kept))
      : kept < 1
          ? fmt::format(
                "They agree in direction, not in degree: contrast between indoors and outdoors keeps {} of "
                "its share.",
                percent(kept))
          : fmt::format("They differ: contrast between indoors and outdoors gets {:.2f} times its share.",
                        kept);
  std::vector<std::string> flatter;
  for (std::size_t i = 1; i < section_operators().size(); ++i)
    if (median(study.outcomes[i].between) < kept) flatter.push_back(study.outcomes[i].chosen.label);
  if (!flatter.empty())
    text += fmt::format(" At default settings less of it is kept by {}.", fmt::join(flatter, "; "));
  const double bright = median(study.outcomes.back().luma_indoors),
               ours = median(study.outcomes[0].luma_indoors);
  text += bright > ours
              ? fmt::format(" Without a ceiling the interior is brighter, at luma {:.2f}, as in the thesis.",
                            bright)
              : fmt::format(
                    " Equalisation without any ceiling shows indoors at luma {:.2f}, not brighter than with "
                    "it, so "
                    "the ceiling is not what keeps figure 45's bright interior away.",
                    bright);
  return text;
}

void describe(ReproductionResult& result, const Study& study) {
  const Outcome &histogram = study.outcomes[0], &bilateral = study.outcomes[1],
                &plain = study.outcomes.back();
  result.ours_shows = fmt::format(
      "Outdoors is {:.2f} log10 units brighter than indoors (medians of the {} key views of the middle row). "
      "Histogram adjustment "
      "shows indoors at luma {:.2f} and outdoors at {:.2f}: {:.2f} of the contrast that a straight line in "
      "log luminance would keep between them, and {:.2f} within indoors and {:.2f} within outdoors. Between "
      "them enhanced bilateral keeps {:.2f}, naive Reinhard 2005 {:.2f}, the robust operator {:.2f}; "
      "histogram adjustment {:.2f} with the linear ceiling, {:.2f} with the one as printed and {:.2f} with "
      "none.",
      median(study.scene_between), study.scene_between.size(), median(histogram.luma_indoors),
      median(histogram.luma_outdoors), median(histogram.between), median(histogram.within_indoors),
      median(histogram.within_outdoors), median(bilateral.between), median(study.outcomes[2].between),
      median(study.outcomes[3].between), median(study.outcomes[4].between), median(study.outcomes[5].between),
      median(plain.between));
  result.differs = compared_with_thesis(study);
}

}  // namespace

ReproductionResult reproduce_flattened_outdoors(Laboratory& laboratory) {
  SectionScene scene(laboratory, "cellar");
  Study study;
  for (SectionOperator& chosen : operators_compared())
    study.outcomes.push_back({.chosen = std::move(chosen)});
  for (const int i : scene.middle_row()) add_view(scene, i, study);
  ReproductionResult result;
  result.paper_shows =
      "Figure 45: histogram adjustment keeps what is visible indoors and outdoors at the cost of the "
      "contrast "
      "between them; in the Cellar the sky in the window is hardly brighter than the interior, which appears "
      "much too bright.";
  if (study.scene_between.empty()) {
    result.ours_shows = "No key view shows both indoors and outdoors in this run.";
    result.differs = "Nothing can be compared.";
    return result;
  }
  add_rows(result.rows, scene, study);
  describe(result, study);
  if (!study.outcomes.front().middle.empty()) add_pictures(result, scene, study);
  result.add_plot("contrast-between-and-within", contrast_plot(study));
  result.add_table(table_of(study));
  return result;
}

}  // namespace plenolab
