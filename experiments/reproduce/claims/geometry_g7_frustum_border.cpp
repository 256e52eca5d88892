#include <fmt/format.h>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g7(Laboratory& laboratory);

namespace {

Verdict decide_border(const std::vector<OccluderStudy>& studies, UnseenBy by) {
  const Interval share = unseen_share(studies, by);
  Verdict verdict =
      decide_claim(share, Comparison::kAbove, kOftenShare, quantity_of(by), "1",
                   fmt::format("95 % Wilson interval over {} placements", placements_of(studies)));
  verdict.scenes = {"flat convex occluders at the image border"};
  verdict.explanation = fmt::format(
      "Single convex occluders of which the key views on one side see a part at the border of their image "
      "and the opposite ones nothing, before a background of 3 to 6 px disparity: share of random placements "
      "that leave a block of at least 3 × 3 px {} in one of five positions: {}. The threshold is the one in "
      "twenty under which occluders inside the frustums count as never failing (A-G4a).",
      by == UnseenBy::kGeometry ? "truly hidden from all key views" : "that synthesis takes from no key view",
      interval_text(share));
  return verdict;
}

}  // namespace

ReproductionResult reproduce_claim_g7(Laboratory& laboratory) {
  ReproductionResult result;
  const auto studies =
      study_occluders(laboratory, convex_shapes(), place_at_border, placements_per_kind(laboratory), 0x4770);
  const Verdict geometry = decide_border(studies, UnseenBy::kGeometry),
                synthesis = decide_border(studies, UnseenBy::kSynthesis);
  result.paper_shows =
      "Figure 31: the vertical beam of the Cellar, though convex, hides wall from the key views that contain "
      "it, while "
      "the others end before that wall: it is unseen (sections 4.1.5 and 6.1.1).";
  const auto percent = [](const Verdict& verdict) {
    const Interval& share = verdict.interval.value();
    return interval_text({100 * share.estimate, 100 * share.low, 100 * share.high});
  };
  result.ours_shows = fmt::format(
      "Convex occluders that lie partly in some frustums and outside the others hide background from all key "
      "views in {} % of placements. {} In synthesis they leave unseen background in {} %. {}",
      percent(geometry), outcome_text(geometry.outcome), percent(synthesis), outcome_text(synthesis.outcome));
  result.differs =
      "Hidden strips are no wider than the disparity of the background, so a far background "
      "hardly shows them. " +
      causes_text(mean_causes(studies));
  add_study(result, studies, "convex at the border");
  result.add_plot(
      "unseen-by-shape",
      plot_of(studies,
              "Single convex occluders partly inside some frustums and outside the others (the "
              "rectangle is a beam longer than the image, as in figure 31): share of placements that "
              "leave unseen background, with 95 % Wilson intervals"));
  add_worst_case(result, studies, "occluder-at-the-border", laboratory.options().threads);
  conclude(result,
           {"A-G7a", "Altmeier 2018, section 6.1.1, figure 31",
            "A convex occluder partly outside the frustums does hide points from all key views."},
           geometry);
  conclude(result,
           {"A-G7b", "Altmeier 2018, section 6.1.1, figure 31",
            "A convex occluder partly outside the frustums does leave points unseen in synthesis."},
           synthesis);
  return result;
}

}  // namespace plenolab
