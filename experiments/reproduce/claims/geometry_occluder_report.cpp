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

double mean_of(const OccluderStudy& study, double OccluderOutcome::*value) {
  double sum = 0;
  for (const OccluderOutcome& outcome : study.outcomes) sum += outcome.*value;
  return sum / static_cast<double>(study.outcomes.size());
}

}  // namespace

void add_study(ReproductionResult& result, const std::vector<OccluderStudy>& studies,
               const std::string& set) {
  for (const OccluderStudy& study : studies) {
    const auto n = study.outcomes.size();
    const std::vector<std::pair<std::string, Cell>> columns{{"occluders", set},
                                                            {"kind", std::string(name_of(study.kind))},
                                                            {"placements", static_cast<long long>(n)}};
    const double placements = static_cast<double>(n);
    result.rows.add(
        {"unseen_placement_share", static_cast<double>(study.unseen()) / placements, "1", columns});
    result.rows.add(
        {"hidden_placement_share", static_cast<double>(study.hidden()) / placements, "1", columns});
    result.rows.add({"unseen_px_per_view", mean_of(study, &OccluderOutcome::unseen_px), "px", columns});
    result.rows.add({"hidden_px_per_view", mean_of(study, &OccluderOutcome::geometry_px), "px", columns});
  }
}

ReportPlot plot_of(const std::vector<OccluderStudy>& studies, std::string caption) {
  Plot plot;
  plot.x.title = "Occluder";
  plot.y = {.title = "Placements that leave unseen background", .unit = "%", .minimum = 0, .maximum = 100};
  plot.key = KeyPosition::kOutside;
  plot.series = {{.title = "synthesis", .points = {}}, {.title = "geometry alone", .points = {}}};
  for (const OccluderStudy& study : studies) {
    plot.categories.emplace_back(name_of(study.kind));
    plot.series[0].points.push_back(bar(share_interval(study.unseen(), study.outcomes.size())));
    plot.series[1].points.push_back(bar(share_interval(study.hidden(), study.outcomes.size())));
  }
  std::string alt = "Bars by kind of occluder, synthesis and geometry:";
  for (const OccluderStudy& study : studies)
    alt += fmt::format(" {} {} and {} of {};", name_of(study.kind), study.unseen(), study.hidden(),
                       study.outcomes.size());
  return {plot, std::move(caption), alt};
}

void add_worst_case(ReproductionResult& result, const std::vector<OccluderStudy>& studies,
                    const std::string& name, int threads) {
  const OccluderPlacement* placement = nullptr;
  const OccluderOutcome* worst = nullptr;
  ShapeKind kind = ShapeKind::kDisc;
  for (const OccluderStudy& study : studies)
    for (std::size_t i = 0; i < study.outcomes.size(); ++i)
      if (worst == nullptr || study.outcomes[i].unseen_px > worst->unseen_px)
        worst = &study.outcomes[i], placement = &study.placements[i], kind = study.kind;
  const FlatWorld world = world_of(*placement, true);
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
           worst->unseen_px, name_of(kind), worst->worst.s, worst->worst.t),
       fmt::format("Truth, synthesised view and visibility map of a probe with the occluder {}",
                   name_of(kind)),
       {{"Ground truth", expose(truth, exposure)},
        {"Synthesised", expose(view.image, exposure)},
        {"Visibility", visibility_map(view)}}},
      {truth, view.image});
}

}  // namespace plenolab
