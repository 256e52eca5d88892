#include <fmt/format.h>

#include <algorithm>

#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

namespace {

PlotPoint bar(const Interval& share) {
  return {.y = 100 * share.estimate, .y_low = 100 * share.low, .y_high = 100 * share.high, .label = {}};
}

/// Share of placements with an outcome.
double share_of(const OccluderStudy& study, bool OccluderOutcome::*outcome) {
  const auto with = std::count_if(study.outcomes.begin(), study.outcomes.end(),
                                  [outcome](const OccluderOutcome& o) { return o.*outcome; });
  return static_cast<double>(with) / static_cast<double>(study.outcomes.size());
}

double mean_geometry_px(const OccluderStudy& study) {
  double sum = 0;
  for (const OccluderOutcome& outcome : study.outcomes) sum += outcome.geometry_px;
  return sum / static_cast<double>(study.outcomes.size());
}

}  // namespace

UnseenCauses mean_causes(const std::vector<OccluderStudy>& studies) {
  UnseenCauses sum;
  double placements = 0;
  for (const OccluderStudy& study : studies)
    for (const OccluderOutcome& outcome : study.outcomes) {
      sum.hidden += outcome.unseen_px.hidden;
      sum.behind += outcome.unseen_px.behind;
      sum.beside += outcome.unseen_px.beside;
      placements += 1;
    }
  return {sum.hidden / placements, sum.behind / placements, sum.beside / placements};
}

std::string causes_text(const UnseenCauses& causes) {
  if (causes.all() == 0) return "";
  const double percent = 100 / causes.all();
  return fmt::format(
      "Of the unseen pixels {:.0f} % are truly hidden from all four key views; {:.0f} % are shown by a key "
      "view, but the path of the search meets the occluder's image before and ends there, though the ray "
      "passes behind it; {:.0f} % lie beside edges, where rule 2 discards what the key views show.",
      percent * causes.hidden, percent * causes.behind, percent * causes.beside);
}

void add_study(ReproductionResult& result, const std::vector<OccluderStudy>& studies,
               const std::string& set) {
  for (const OccluderStudy& study : studies) {
    const auto n = study.outcomes.size();
    const std::vector<std::pair<std::string, Cell>> columns{
        {"occluders", set}, {"kind", study.name}, {"placements", static_cast<long long>(n)}};
    for (const auto& [quantity, outcome] :
         {std::pair{"unseen_placement_share", &OccluderOutcome::unseen},
          {"hidden_placement_share", &OccluderOutcome::hidden},
          {"unseen_placement_share_one_px_rim", &OccluderOutcome::unseen_2x2},
          {"hidden_placement_share_one_px_rim", &OccluderOutcome::hidden_2x2}})
      result.rows.add({quantity, share_of(study, outcome), "1", columns});
    const UnseenCauses causes = mean_causes({study});
    result.rows.add({"unseen_px_per_view", causes.all(), "px", columns});
    result.rows.add({"unseen_hidden_px_per_view", causes.hidden, "px", columns});
    result.rows.add({"unseen_behind_px_per_view", causes.behind, "px", columns});
    result.rows.add({"unseen_beside_px_per_view", causes.beside, "px", columns});
    result.rows.add({"hidden_px_per_view", mean_geometry_px(study), "px", columns});
  }
}

void add_geometry_study(ReproductionResult& result, const std::vector<OccluderStudy>& geometry,
                        const std::string& set) {
  for (const OccluderStudy& study : geometry)
    result.rows.add({"hidden_placement_share",
                     share_of(study, &OccluderOutcome::hidden),
                     "1",
                     {{"occluders", set + ", geometry alone"},
                      {"kind", study.name},
                      {"placements", static_cast<long long>(study.outcomes.size())}}});
}

ReportPlot plot_of(const std::vector<OccluderStudy>& studies, std::string caption) {
  return plot_of(studies, studies, std::move(caption));
}

ReportPlot plot_of(const std::vector<OccluderStudy>& studies, const std::vector<OccluderStudy>& geometry,
                   std::string caption) {
  Plot plot;
  plot.x.title = "Occluder";
  plot.y = {.title = "Placements that leave unseen background", .unit = "%", .minimum = 0, .maximum = 100};
  plot.key = KeyPosition::kOutside;
  plot.series = {{.title = "synthesis", .points = {}}, {.title = "geometry alone", .points = {}}};
  std::string alt = "Bars by kind of occluder, synthesis and geometry:";
  for (std::size_t i = 0; i < studies.size(); ++i) {
    const Interval unseen = share_interval(studies[i].unseen(), studies[i].outcomes.size());
    const Interval hidden = share_interval(geometry[i].hidden(), geometry[i].outcomes.size());
    plot.categories.push_back(studies[i].name);
    plot.series[0].points.push_back(bar(unseen));
    plot.series[1].points.push_back(bar(hidden));
    alt += fmt::format(" {} {:.1f} and {:.1f} %;", studies[i].name, 100 * unseen.estimate,
                       100 * hidden.estimate);
  }
  return {plot, std::move(caption), alt};
}

void add_worst_case(ReproductionResult& result, const std::vector<OccluderStudy>& studies,
                    const std::string& name, int threads) {
  const OccluderPlacement* placement = nullptr;
  const OccluderOutcome* worst = nullptr;
  std::string kind;
  for (const OccluderStudy& study : studies)
    for (std::size_t i = 0; i < study.outcomes.size(); ++i)
      if (worst == nullptr || study.outcomes[i].unseen_px.all() > worst->unseen_px.all())
        worst = &study.outcomes[i], placement = &study.placements[i], kind = study.name;
  const FlatWorld world = world_of(*placement, Patterned::kEverything);
  const ViewGrid grid = occluder_grid();
  SynthesisOptions options;
  options.threads = threads;
  const auto view = synthesize(flat_light_field(world, grid, name, threads), worst->worst, options);
  const SceneImage truth = flat_view(world, grid, worst->worst, threads).colour;
  const float exposure = exposure_from(truth);
  result.add_comparison(
      name,
      {fmt::format(
           "The placement with most unseen background ({:.0f} px beyond the rim, mean over the positions): "
           "{}, drawn with patterns, from ({:.2f}, {:.2f}) in the cell",
           worst->unseen_px.all(), kind, worst->worst.s, worst->worst.t),
       fmt::format("Truth, synthesised view and visibility map of a probe with the occluder {}", kind),
       {{"Ground truth", expose(truth, exposure)},
        {"Synthesised", expose(view.image, exposure)},
        {"Visibility", visibility_map(view)}}},
      {truth, view.image});
}

}  // namespace plenolab
