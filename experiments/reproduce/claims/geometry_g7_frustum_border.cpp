#include <fmt/format.h>

#include <algorithm>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g7(Laboratory& laboratory);

namespace {

// Of each kind, as for pairs of occluders (A-G5).
constexpr int kPlacements = 240, kGeometryPlacements = 960;

/// The claim is made for a beam along the image border (figure 31); whether it holds for convex occluders in
/// general is another question, and their mean would answer neither.
struct BorderStudies {
  std::vector<OccluderStudy> synthesis, geometry;
  std::vector<OccluderStudy> beams, compact;  ///< geometry, apart
};

BorderStudies study_border(Laboratory& laboratory) {
  BorderStudies s;
  s.synthesis = study_occluders(laboratory, convex_shapes(), place_at_border,
                                placements_per_kind(laboratory, kPlacements), 0x4770);
  s.geometry = study_geometry(laboratory, convex_shapes(), place_at_border,
                              placements_per_kind(laboratory, kGeometryPlacements), 0x4771);
  for (std::vector<OccluderStudy>* studies : {&s.synthesis, &s.geometry})
    for (OccluderStudy& study : *studies)
      if (study.kind == ShapeKind::kBar) study.name = "beam";  // see place_at_border
  std::partition_copy(s.geometry.begin(), s.geometry.end(), std::back_inserter(s.beams),
                      std::back_inserter(s.compact),
                      [](const OccluderStudy& study) { return study.kind == ShapeKind::kBar; });
  return s;
}

Verdict decide_border(const std::vector<OccluderStudy>& studies, UnseenBy by, const std::string& occluders) {
  const Interval share = unseen_share(studies, by);
  Verdict verdict =
      decide_claim(share, Comparison::kAbove, kOftenShare, quantity_of(by), "1",
                   fmt::format("95 % Wilson interval over {} placements", placements_of(studies)));
  verdict.scenes = {fmt::format("flat {} at the image border", occluders)};
  verdict.explanation = fmt::format(
      "Single {} of which the key views on one side see a part at the border of their image and the opposite "
      "ones nothing, before a background of 3 to 6 px disparity: share of random placements that leave a "
      "block of at least 3 × 3 px {} in one of five positions: {}. The threshold is the one in twenty under "
      "which occluders inside the frustums count as never failing (A-G4a).",
      occluders,
      by == UnseenBy::kGeometry ? "truly hidden from all key views" : "that synthesis takes from no key view",
      interval_text(share));
  return verdict;
}

std::string percent_of(const Verdict& verdict) {
  const Interval& share = verdict.interval.value();
  return interval_text({100 * share.estimate, 100 * share.low, 100 * share.high});
}

void show(ReproductionResult& result, const BorderStudies& studies, int threads) {
  add_study(result, studies.synthesis, "convex at the border");
  add_geometry_study(result, studies.geometry, "convex at the border");
  result.add_plot(
      "unseen-by-shape",
      plot_of(
          studies.synthesis, studies.geometry,
          "Single convex occluders partly inside some frustums and outside the others (the beam is longer "
          "than the image, as in figure 31): share of placements that leave unseen background, with 95 % "
          "Wilson intervals"));
  add_worst_case(result, studies.synthesis, "occluder-at-the-border", threads);
}

}  // namespace

ReproductionResult reproduce_claim_g7(Laboratory& laboratory) {
  ReproductionResult result;
  const BorderStudies studies = study_border(laboratory);
  const Verdict beams = decide_border(studies.beams, UnseenBy::kGeometry, "beams"),
                compact = decide_border(studies.compact, UnseenBy::kGeometry, "discs, squares and hexagons"),
                synthesis = decide_border(studies.synthesis, UnseenBy::kSynthesis, "convex occluders");
  result.paper_shows =
      "Figure 31: the vertical beam of the Cellar, though convex, hides wall from the key views that contain "
      "it, while the others end before that wall: it is unseen (sections 4.1.5 and 6.1.1).";
  result.ours_shows = fmt::format(
      "Beams that lie partly in some frustums and outside the others hide background from all key views in "
      "{} % of placements. {} Compact convex occluders do in {} %. {} In synthesis all kinds together leave "
      "unseen background in {} %. {}",
      percent_of(beams), outcome_text(beams.outcome), percent_of(compact), outcome_text(compact.outcome),
      percent_of(synthesis), outcome_text(synthesis.outcome));
  result.differs =
      "Hidden strips are no wider than the disparity of the background, so a far background hardly shows "
      "them, and no longer than what of the occluder lies along the border: beams hide more than compact "
      "occluders. They are judged apart since a first measurement that pooled them decided nothing. " +
      causes_text(mean_causes(studies.synthesis));
  show(result, studies, laboratory.options().threads);
  const char* where = "Altmeier 2018, section 6.1.1, figure 31";
  conclude(result,
           {"A-G7a", where, "A beam partly outside the frustums does hide points from all key views."},
           beams);
  conclude(result,
           {"A-G7b", where,
            "A compact convex occluder partly outside the frustums does hide points from all key views."},
           compact);
  conclude(result,
           {"A-G7c", where,
            "A convex occluder partly outside the frustums does leave points unseen in synthesis."},
           synthesis);
  return result;
}

}  // namespace plenolab
