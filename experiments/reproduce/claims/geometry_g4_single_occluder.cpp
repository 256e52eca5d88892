#include <fmt/format.h>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g4(Laboratory& laboratory);

namespace {

Verdict decide_set(const std::vector<OccluderStudy>& studies, Comparison comparison, const std::string& set) {
  const Interval share = unseen_share(studies);
  Verdict verdict =
      decide_claim(share, comparison, kOftenShare, "unseen_placement_share", "1",
                   fmt::format("95 % Wilson interval over {} placements", placements_of(studies)));
  verdict.scenes = {fmt::format("flat {} occluders", set)};
  verdict.explanation = fmt::format(
      "Share of random single {} occluders, wholly inside the four frustums, that leave background no key "
      "view sees "
      "in at least one of five positions of the cell: {} of placements. Unseen means visible in no key view "
      "before "
      "restoration, in a block of 3 × 3 px or more, so that the pixel which sampling costs at either side "
      "does not "
      "count. The threshold of one in twenty is what this number of placements can tell from never.",
      set, interval_text(share));
  return verdict;
}

}  // namespace

ReproductionResult reproduce_claim_g4(Laboratory& laboratory) {
  ReproductionResult result;
  const int count = placements_per_kind(laboratory);
  const auto convex = study_occluders(laboratory, convex_shapes(), place_inside, count, 0x4734);
  const auto concave = study_occluders(laboratory, concave_shapes(), place_inside, count, 0x4735);
  const Verdict never = decide_set(convex, Comparison::kBelow, "convex");
  const Verdict can = decide_set(concave, Comparison::kAbove, "concave");
  result.paper_shows =
      "A single occluder without negative curvature that lies wholly in the four frustums never causes "
      "unseen points; "
      "slits, holes and concave silhouettes can (section 4.1.5, figure 17, an argument without measurement).";
  result.ours_shows = fmt::format(
      "Of the convex occluders {} % leave an unseen block of 3 × 3 px of background: {} Of those with a "
      "concave "
      "corner, slit, hole or gaps {} % do: {}",
      interval_text({100 * never.number, 100 * never.interval->low, 100 * never.interval->high}),
      outcome_text(never.outcome),
      interval_text({100 * can.number, 100 * can.interval->low, 100 * can.interval->high}),
      outcome_text(can.outcome));
  std::size_t hidden_convex = 0, hidden_concave = 0, unseen_concave = 0;
  for (const auto& study : convex) hidden_convex += study.hidden();
  for (const auto& study : concave) hidden_concave += study.hidden(), unseen_concave += study.unseen();
  result.differs = fmt::format(
      "Geometry alone, without sampling and search, hides a block of 3 × 3 px from all four key views for {} "
      "of the "
      "convex and "
      "{} of the concave placements; synthesis misses some for {} of the concave ones. {}",
      hidden_convex, hidden_concave, unseen_concave, causes_text(mean_causes(concave)));
  add_study(result, convex, "convex");
  add_study(result, concave, "concave");
  auto all = convex;
  all.insert(all.end(), concave.begin(), concave.end());
  result.add_plot("unseen-by-shape",
                  plot_of(all,
                          "Single occluders inside all four frustums: share of placements that leave unseen "
                          "background, with 95 % Wilson intervals"));
  add_worst_case(result, concave, "concave-occluder", laboratory.options().threads);
  conclude(result,
           {"A-G4a", "Altmeier 2018, section 4.1.5",
            "One occluder without negative curvature, all of it inside the four frustums, never causes "
            "unseen points."},
           never);
  conclude(result,
           {"A-G4b", "Altmeier 2018, section 4.1.5",
            "One occluder with slits, holes or a concave silhouette can cause unseen points."},
           can);
  return result;
}

}  // namespace plenolab
