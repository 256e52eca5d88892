#include <fmt/format.h>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g4(Laboratory& laboratory);

namespace {

constexpr int kPlacements = 24;  // of each kind: see kOftenShare

Verdict decide_set(const std::vector<OccluderStudy>& studies, Comparison comparison, const std::string& set) {
  const Interval share = unseen_share(studies);
  Verdict verdict =
      decide_claim(share, comparison, kOftenShare, "unseen_placement_share", "1",
                   fmt::format("95 % Wilson interval over {} placements", placements_of(studies)));
  verdict.scenes = {fmt::format("flat {} occluders", set)};
  verdict.explanation = fmt::format(
      "Share of random single {} occluders, wholly inside the four frustums, that leave background no key "
      "view sees in at least one of five positions of the cell: {} of placements. Unseen means visible in no "
      "key view before restoration, in a block of 3 × 3 px or more, so that the pixel which sampling costs "
      "at either side does not count. The threshold of one in twenty is what this number of placements can "
      "tell from never.",
      set, interval_text(share));
  return verdict;
}

struct SingleOccluders {
  std::vector<OccluderStudy> convex, concave;
  Verdict never, can;  ///< leave background unseen: convex ones never, concave ones can
};

SingleOccluders study_both(Laboratory& laboratory) {
  const int count = placements_per_kind(laboratory, kPlacements);
  SingleOccluders studies;
  studies.convex = study_occluders(laboratory, convex_shapes(), place_inside, count, 0x4734);
  studies.concave = study_occluders(laboratory, concave_shapes(), place_inside, count, 0x4735);
  studies.never = decide_set(studies.convex, Comparison::kBelow, "convex");
  studies.can = decide_set(studies.concave, Comparison::kAbove, "concave");
  return studies;
}

std::string shares_sentence(const SingleOccluders& studies) {
  const auto text = [](const Verdict& verdict) {
    const Interval& share = verdict.interval.value();
    return interval_text({100 * share.estimate, 100 * share.low, 100 * share.high});
  };
  return fmt::format(
      "Of the convex occluders {} % leave an unseen block of 3 × 3 px of background: {} Of those with a "
      "concave corner, slit, hole or gaps {} % do: {}",
      text(studies.never), outcome_text(studies.never.outcome), text(studies.can),
      outcome_text(studies.can.outcome));
}

std::string geometry_sentence(const SingleOccluders& studies) {
  std::size_t hidden_convex = 0, hidden_concave = 0, unseen_concave = 0;
  for (const auto& study : studies.convex) hidden_convex += study.hidden();
  for (const auto& study : studies.concave)
    hidden_concave += study.hidden(), unseen_concave += study.unseen();
  return fmt::format(
      "Geometry alone, without sampling and search, hides a block of 3 × 3 px from all four key views for {} "
      "of the convex and {} of the concave placements; synthesis misses some for {} of the concave ones. {}",
      hidden_convex, hidden_concave, unseen_concave, causes_text(mean_causes(studies.concave)));
}

void show(ReproductionResult& result, const SingleOccluders& studies, int threads) {
  add_study(result, studies.convex, "convex");
  add_study(result, studies.concave, "concave");
  auto all = studies.convex;
  all.insert(all.end(), studies.concave.begin(), studies.concave.end());
  result.add_plot("unseen-by-shape",
                  plot_of(all,
                          "Single occluders inside all four frustums: share of placements that leave unseen "
                          "background, with 95 % Wilson intervals"));
  add_worst_case(result, studies.concave, "concave-occluder", threads);
}

}  // namespace

ReproductionResult reproduce_claim_g4(Laboratory& laboratory) {
  ReproductionResult result;
  const SingleOccluders studies = study_both(laboratory);
  result.paper_shows =
      "A single occluder without negative curvature that lies wholly in the four frustums never causes "
      "unseen points; slits, holes and concave silhouettes can (section 4.1.5, figure 17, an argument "
      "without measurement).";
  result.ours_shows = shares_sentence(studies);
  result.differs = geometry_sentence(studies);
  show(result, studies, laboratory.options().threads);
  conclude(result,
           {"A-G4a", "Altmeier 2018, section 4.1.5",
            "One occluder without negative curvature, all of it inside the four frustums, never causes "
            "unseen points."},
           studies.never);
  conclude(result,
           {"A-G4b", "Altmeier 2018, section 4.1.5",
            "One occluder with slits, holes or a concave silhouette can cause unseen points."},
           studies.can);
  return result;
}

}  // namespace plenolab
