#include <fmt/format.h>

#include <algorithm>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g5(Laboratory& laboratory);

namespace {

// As for single occluders (geometry_g4): what "cause" must exceed is what never-causing could look like.
constexpr double kShare = 0.05;

}  // namespace

ReproductionResult reproduce_claim_g5(Laboratory& laboratory) {
  ReproductionResult result;
  const int count = placements_per_kind(laboratory);
  const auto studies = study_occluders(laboratory, convex_shapes(), place_pair, count, 0x4750);
  const auto rarest = std::min_element(studies.begin(), studies.end(),
                                       [](const auto& a, const auto& b) { return a.unseen() < b.unseen(); });
  const Interval share = unseen_share(studies);
  std::size_t hidden = 0, unseen = 0, placements = 0;
  for (const auto& study : studies)
    hidden += study.hidden(), unseen += study.unseen(), placements += study.outcomes.size();
  Verdict verdict = decide_claim(share, Comparison::kAbove, kShare, "unseen_placement_share", "1",
                                 fmt::format("95 % Wilson interval over {} placements", placements));
  verdict.scenes = {"two flat convex occluders"};
  verdict.explanation = fmt::format(
      "Two convex occluders of one kind beside each other, 2 to 6 px apart and larger than what they move by "
      "against the "
      "background, wholly inside the four frustums: share of random placements of four kinds that leave a "
      "block of at "
      "least 3 × 3 px seen by no key view in one of five positions: {}. The threshold is the one in twenty "
      "under which "
      "single convex occluders count as never failing (A-G4a).",
      interval_text(share));
  result.paper_shows =
      "With several occluders unseen points appear whatever their shape, because background between two of "
      "them can be "
      "hidden by one in some key views and by the other in the rest (sections 4.1.5, 6.1.1: holes in the "
      "foliage).";
  result.ours_shows = fmt::format(
      "Two neighbouring convex occluders leave unseen background in {} % of placements. {} Least often {}s "
      "do, in {} of "
      "{} placements.",
      interval_text({100 * share.estimate, 100 * share.low, 100 * share.high}), outcome_text(verdict.outcome),
      name_of(rarest->kind), rarest->unseen(), rarest->outcomes.size());
  result.differs = fmt::format(
      "Our occluders stand close together and are larger than their displacement between key views; far "
      "apart or small "
      "they act as single ones. Geometry alone hides a block of 3 × 3 px from all key views in {} of the {} "
      "placements, synthesis "
      "misses some in {}. {}",
      hidden, placements, unseen, causes_text(mean_causes(studies)));
  add_study(result, studies, "two convex");
  result.add_plot("unseen-by-shape", plot_of(studies,
                                             "Two convex occluders side by side: share of placements that "
                                             "leave unseen background, with 95 % Wilson intervals"));
  add_worst_case(result, studies, "two-occluders", laboratory.options().threads);
  conclude(result,
           {"A-G5", "Altmeier 2018, sections 4.1.5 and 6.1.1",
            "Several occluders cause unseen points whatever their shape."},
           std::move(verdict));
  return result;
}

}  // namespace plenolab
