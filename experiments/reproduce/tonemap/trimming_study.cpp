#include "experiments/reproduce/tonemap/trimming_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/score.h"
#include "stimuli/render.h"

namespace plenolab {

std::vector<CeilingStudy> study_scene(Laboratory& laboratory, const std::string& id, bool dark) {
  const int threads = laboratory.options().threads;
  const ToneScene scene = tone_scene(laboratory, id);
  std::vector<CeilingStudy> studies;
  const double paper_spacing_m = grid_of(laboratory.scene(id), Preset::kPaper).spacing_x_m;
  for (const HistogramCeiling ceiling : kCeilings)
    studies.push_back({dark, measure_trimming_consistency(scene, ceiling, std::nullopt, threads),
                       measure_trimming_consistency(scene, ceiling, kFixedPasses, threads),
                       scene.field.grid().spacing_x_m, paper_spacing_m});
  return studies;
}

std::size_t count_shown(const TrimmingConsistency& run) {
  return static_cast<std::size_t>(
      std::count_if(run.different.begin(), run.different.end(),
                    [](const DifferentPasses& pair) { return pair.added() > visible_luma_change(); }));
}

std::string passes_text(const TrimmingConsistency& run) {
  const auto [low, high] = std::minmax_element(run.passes.begin(), run.passes.end());
  return *low == *high ? fmt::format("{}", *low) : fmt::format("{} to {}", *low, *high);
}

void add_run_rows(ResultTable& rows, const TrimmingConsistency& run) {
  const Columns columns{{"scene", run.scene},
                        {"ceiling", name_of(run.ceiling)},
                        {"passes", run.fixed_passes ? fmt::format("{}", *run.fixed_passes) : "automatic"}};
  rows.add({"linear_views", static_cast<double>(run.linear_views), "views", columns});
  for (std::size_t i = 0; i < run.passes.size(); ++i) {
    Columns view = columns;
    view.emplace_back("view", static_cast<long long>(i));
    rows.add({"trimming_passes", static_cast<double>(run.passes[i]), "passes", view});
  }
  if (run.pairs.empty()) return;
  rows.add({"mean_added_luma_change", run.mean_added(), "luma", columns});
  rows.add({"largest_added_luma_change", run.largest_added(), "luma", columns});
  const auto add_count = [&](const char* quantity, std::size_t count) {
    rows.add({quantity, static_cast<double>(count), "pairs", columns});
  };
  add_count("pairs", run.pairs.size());
  add_count("neighbours", run.neighbours);
  add_count("neighbours_with_different_passes", run.different.size());
  add_count("neighbours_that_show_it", count_shown(run));
}

ReportTable passes_table(const std::vector<TrimmingConsistency>& runs) {
  ReportTable table{"Numbers of trimming passes of all key views, and how many of these end linear",
                    {"scene", "ceiling", "passes", "linear views", "pairs of neighbours",
                     "with different passes", "visibly"},
                    {},
                    3};
  for (const TrimmingConsistency& run : runs) {
    const bool compared = run.neighbours > 0;
    const auto counted = [&](std::size_t n) { return compared ? Cell{static_cast<long long>(n)} : Cell{""}; };
    table.rows.push_back({run.title, name_of(run.ceiling), passes_text(run),
                          static_cast<long long>(run.linear_views), counted(run.neighbours),
                          counted(run.different.size()), counted(count_shown(run))});
  }
  return table;
}

ReportTable change_table(const std::vector<CeilingStudy>& studies) {
  const std::string fixed = fmt::format("{} passes", kFixedPasses);
  ReportTable table{
      "Change of luma from neighbour to neighbour that the difference of their curves adds (RMS "
      "over corresponding pixels)",
      {"scene", "ceiling", "pairs", "automatic: mean", "automatic: largest", fixed + ": mean",
       fixed + ": largest"},
      {},
      3};
  for (const CeilingStudy& study : studies)
    table.rows.push_back({study.automatic.title, name_of(study.automatic.ceiling),
                          static_cast<long long>(study.automatic.pairs.size()), study.automatic.mean_added(),
                          study.automatic.largest_added(), study.fixed.mean_added(),
                          study.fixed.largest_added()});
  return table;
}

ReportPlot change_plot(const std::vector<CeilingStudy>& studies) {
  Plot plot;
  plot.y = {.title = "Mean change of luma that the curves add", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  for (const HistogramCeiling ceiling : kCeilings)
    for (const bool fixed : {false, true}) {
      PlotSeries series{.title = name_of(ceiling) + (fixed ? fmt::format(", {} passes", kFixedPasses)
                                                           : std::string(", automatic"))};
      for (const CeilingStudy& study : studies)
        if (study.automatic.ceiling == ceiling)
          series.points.push_back({.y = (fixed ? study.fixed : study.automatic).mean_added()});
      plot.series.push_back(std::move(series));
    }
  for (const CeilingStudy& study : studies)
    if (study.automatic.ceiling == HistogramCeiling::kPerceptual)
      plot.categories.push_back(study.automatic.scene);
  return {plot,
          fmt::format("Change between neighbouring key views; {:.4f} is just visible", visible_luma_change()),
          "Bars of two ceilings with two numbers of passes for each scene"};
}

}  // namespace plenolab
