#include <fmt/format.h>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g7(Laboratory& laboratory);

namespace {

// As for single occluders inside the frustums (geometry_g4), whose claim this one limits.
constexpr double kShare = 0.05;

}  // namespace

ReproductionResult reproduce_claim_g7(Laboratory& laboratory) {
  ReproductionResult result;
  const auto studies =
      study_occluders(laboratory, convex_shapes(), place_at_border, placements_per_kind(laboratory), 0x4770);
  const Interval share = unseen_share(studies);
  std::size_t placements = 0, hidden = 0, unseen = 0;
  for (const auto& study : studies)
    placements += study.outcomes.size(), hidden += study.hidden(), unseen += study.unseen();
  Verdict verdict = decide_claim(share, Comparison::kAbove, kShare, "unseen_placement_share", "1",
                                 fmt::format("95 % Wilson interval over {} placements", placements));
  verdict.scenes = {"flat convex occluders at the image border"};
  verdict.explanation = fmt::format(
      "Single convex occluders of which the key views on one side see a part at the border of their image "
      "and the "
      "opposite ones nothing, before a background of 3 to 6 px disparity: share of random placements that "
      "leave a block "
      "of at least 3 × 3 px seen by no key view in one of five positions: {}. The threshold is the one in "
      "twenty under "
      "which occluders inside the frustums count as never failing (A-G4a).",
      interval_text(share));
  result.paper_shows =
      "Figure 31: the vertical beam of the Cellar, though convex, hides wall from the key views that contain "
      "it, while "
      "the others end before that wall: it is unseen (sections 4.1.5 and 6.1.1).";
  result.ours_shows = fmt::format(
      "Convex occluders that lie partly in some frustums and outside the others leave unseen background in "
      "{} % of placements. {}",
      interval_text({100 * share.estimate, 100 * share.low, 100 * share.high}),
      outcome_text(verdict.outcome));
  result.differs = fmt::format(
      "Geometry alone leaves a block of 3 × 3 px to no key view in {} of {} placements, synthesis in {}. {} "
      "The "
      "strips are no wider "
      "than the disparity of the background, so a far background hardly shows them.",
      hidden, placements, unseen, causes_text(mean_causes(studies)));
  add_study(result, studies, "convex at the border");
  result.add_plot(
      "unseen-by-shape",
      plot_of(studies,
              "Single convex occluders partly inside some frustums and outside the others (the "
              "rectangle is a beam longer than the image, as in figure 31): share of placements that "
              "leave unseen background, with 95 % Wilson intervals"));
  add_worst_case(result, studies, "occluder-at-the-border", laboratory.options().threads);
  conclude(result,
           {"A-G7", "Altmeier 2018, section 6.1.1, figure 31",
            "A convex occluder partly outside the frustums does cause unseen points."},
           std::move(verdict));
  return result;
}

}  // namespace plenolab
