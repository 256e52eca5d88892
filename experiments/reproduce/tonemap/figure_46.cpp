#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/tonemap/suitability_measures.h"

namespace plenolab {

ReproductionResult reproduce_unused_range(Laboratory& laboratory);

namespace {

constexpr int kLumaBins = 25;

double value_of(const FittedOperator& fit, const std::string& name) {
  for (const FittedValue& value : fit.values)
    if (value.name == name) return value.value;
  return 0;
}

constexpr double kWideContrast = 50;

/// What the setting contrast=50 comes to for the same bases, without measuring them again: compression and
/// brightness grow with the logarithm of the contrast.
SectionOperator wide_bilateral(const FittedOperator& fit, double contrast) {
  const double compression = value_of(fit, "compression");
  const double growth = std::min(std::log(kWideContrast) / std::log(contrast), 1 / compression);
  return section_operator(fmt::format("Bilateral, contrast {:g}", kWideContrast), "bilateral", "enhanced",
                          {fmt::format("compression={}", std::min(1.0, compression * growth)),
                           fmt::format("brightness={}", value_of(fit, "brightness") * growth)});
}

/// The bilateral operator is first; the others of the section follow, then a larger contrast of its bases.
std::vector<SectionOperator> operators_compared(SectionScene& scene) {
  std::vector<SectionOperator> all = section_operators();
  std::swap(all[0], all[1]);
  all.push_back(wide_bilateral(scene.joint_fit(all[0]), all[0].choice.values.at("contrast").number));
  return all;
}

/// An operator over all key views.
struct Outcome {
  SectionOperator chosen;
  std::vector<double> low, high, used, water_used, within_water;
  DisplayImage middle;
};

struct Study {
  std::vector<Outcome> outcomes;
  std::vector<double> scene_log10, water_log10;  ///< first percentile to 99th of each key view
};

void add_view(SectionScene& scene, int index, Study& study) {
  const SectionView view = scene.view(index);
  const ViewAndWater parts = view_and_water(view);
  study.scene_log10.push_back(view.log_range());
  study.water_log10.push_back(parts.water.log_luminance.range());
  for (Outcome& o : study.outcomes) {
    DisplayImage mapped = scene.map(o.chosen, index);
    const UsedRange n = measure(view, parts, luma_plane(mapped));
    o.low.push_back(n.all.low);
    o.high.push_back(n.all.high);
    o.used.push_back(n.all.range());
    o.water_used.push_back(n.water.range());
    o.within_water.push_back(n.within_water);
    if (index == scene.middle()) o.middle = std::move(mapped);
  }
}

ReportTable table_of(const Study& study) {
  ReportTable table{fmt::format("Luma of the {} key views of the middle row (medians). Contrast: luma per "
                                "log luminance, 1 = a straight line from "
                                "the first to the 99th percentile of the view",
                                study.scene_log10.size()),
                    {"operator", "first percentile", "99th percentile", "range used", "range in water",
                     "contrast in water"},
                    {}};
  table.digits = 3;
  for (const Outcome& o : study.outcomes)
    table.rows.push_back({o.chosen.label, median(o.low), median(o.high), median(o.used), median(o.water_used),
                          median(o.within_water)});
  return table;
}

/// Share of the pixels by luma.
PlotSeries luma_curve(const Outcome& outcome) {
  std::vector<double> counts(kLumaBins, 0.0);
  const Plane<float> luma = luma_plane(outcome.middle);
  for (const float v : luma.pixels())
    counts[static_cast<std::size_t>(std::clamp(static_cast<int>(v * kLumaBins), 0, kLumaBins - 1))] += 1;
  PlotSeries series{.title = outcome.chosen.label};
  for (std::size_t i = 0; i < counts.size(); ++i)
    series.points.push_back({.x = (static_cast<double>(i) + 0.5) / kLumaBins,
                             .y = 100 * counts[i] / static_cast<double>(luma.size())});
  return series;
}

ReportPlot luma_plot(const Study& study, const std::string& view) {
  Plot plot;
  plot.x = {.title = "Luma", .minimum = 0, .maximum = 1};
  plot.y = {.title = "Pixels", .unit = "% for 0.04 luma", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 940;
  for (const Outcome& o : study.outcomes) plot.series.push_back(luma_curve(o));
  return {plot, fmt::format("How operators use the range of the display: luma of key view {}", view),
          "Histograms of luma of the boats for five mappings"};
}

void add_rows(ResultTable& rows, const SectionScene& scene, const Study& study) {
  for (const Outcome& o : study.outcomes) {
    const Columns columns{{"scene", scene.id()}, {"operator", o.chosen.label}};
    rows.add({"luma_p1", median(o.low), "luma", columns});
    rows.add({"luma_p99", median(o.high), "luma", columns});
    rows.add({"luma_range_used", median(o.used), "luma", columns});
    rows.add({"luma_range_water", median(o.water_used), "luma", columns});
    rows.add({"relative_contrast_water", median(o.within_water), "1", columns});
  }
  rows.add({"scene_range", median(study.scene_log10), "log10", {{"scene", scene.id()}}});
  rows.add({"water_range", median(study.water_log10), "log10", {{"scene", scene.id()}}});
}

void add_pictures(ReproductionResult& result, const SectionScene& scene, const Study& study) {
  const SectionView view = scene.view(scene.middle());
  const ViewAndWater parts = view_and_water(view);
  ImageComparison comparison{
      fmt::format("{}, key view {}. Parts: water up to 100 m away, blue", scene.title(), view.name),
      "The boats tone mapped by several operators, and which part is water",
      {}};
  for (const Outcome& o : study.outcomes) comparison.images.push_back({o.chosen.label, o.middle});
  comparison.images.push_back(
      {"Parts", region_map(study.outcomes.front().middle, {{parts.water.mask, {0.3f, 0.6f, 1}}})});
  result.add_comparison("boats", std::move(comparison));
  result.add_plot("luma", luma_plot(study, view.name));
}

std::string compared_with_thesis(const Study& study) {
  const Outcome &bilateral = study.outcomes.front(), &wide = study.outcomes.back();
  std::size_t wider = 0;
  for (std::size_t i = 1; i < section_operators().size(); ++i)
    wider += median(study.outcomes[i].used) > median(bilateral.used) ? 1 : 0;
  const double unused = 1 - median(bilateral.used);
  std::string text =
      unused > 0.25
          ? fmt::format("They agree: {} of the range of luma lies unused", percent(unused))
          : fmt::format("They differ in degree: {} of the range of luma lies unused here", percent(unused));
  text += fmt::format(", and {} of the {} other operators use more of it.", wider,
                      section_operators().size() - 1);
  text += fmt::format(
      " It follows from the contrast of 5 that the bases are compressed to, not from the filter: with a "
      "contrast of 50, {:.2f} of luma is used.",
      median(wide.used));
  return text;
}

void describe(ReproductionResult& result, const Study& study) {
  const Outcome& bilateral = study.outcomes.front();
  result.ours_shows = fmt::format(
      "The scene spans {:.1f} log10 units (first to 99th percentile, median of the {} key views of the "
      "middle row), its water "
      "{:.1f}. The enhanced bilateral operator shows them from luma {:.2f} to {:.2f}: {:.2f} of the range is "
      "used, and {:.2f} in the water. Histogram adjustment uses {:.2f} ({:.2f} in the water), naive Reinhard "
      "2005 {:.2f} ({:.2f}), the robust operator {:.2f} ({:.2f}).",
      median(study.scene_log10), study.scene_log10.size(), median(study.water_log10), median(bilateral.low),
      median(bilateral.high), median(bilateral.used), median(bilateral.water_used),
      median(study.outcomes[1].used), median(study.outcomes[1].water_used), median(study.outcomes[2].used),
      median(study.outcomes[2].water_used), median(study.outcomes[3].used),
      median(study.outcomes[3].water_used));
  result.differs = compared_with_thesis(study);
}

}  // namespace

ReproductionResult reproduce_unused_range(Laboratory& laboratory) {
  SectionScene scene(laboratory, "boats");
  Study study;
  for (SectionOperator& chosen : operators_compared(scene))
    study.outcomes.push_back({.chosen = std::move(chosen)});
  for (const int i : scene.middle_row()) add_view(scene, i, study);
  ReproductionResult result;
  result.paper_shows =
      "Figure 46: enhanced bilateral filtering of Boats and Lanterns lacks global contrast within the dark "
      "and "
      "the bright parts, the water above all, and leaves a large part of the display's range unused.";
  add_rows(result.rows, scene, study);
  describe(result, study);
  add_pictures(result, scene, study);
  result.add_table(table_of(study));
  return result;
}

}  // namespace plenolab
