#include <fmt/format.h>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"

namespace plenolab {

ReproductionResult reproduce_claim_g5(Laboratory& laboratory);

namespace {

// Of each kind. A kind that never leaves such background then has an interval up to 2.5 %, half of
// kOftenShare, and one at twice kOftenShare an interval that stays above it.
constexpr int kPlacements = 240;
// Geometry alone is fast: shares of 3.2 % and of 6.8 % are told from kOftenShare.
constexpr int kGeometryPlacements = 960;

/// "Whatever their shape" holds if it holds for the kind with the fewest such placements. That kind is chosen
/// by its number among four, so its interval is as wide as four need that hold together.
Verdict decide_any_shape(const std::vector<OccluderStudy>& studies, UnseenBy by) {
  const OccluderStudy& rarest = rarest_of(studies, by);
  const Interval share = share_interval(unseen_of(rarest, by), rarest.outcomes.size(), kNormal95OfFour);
  Verdict verdict =
      decide_claim(share, Comparison::kAbove, kOftenShare, quantity_of(by), "1",
                   fmt::format("Wilson interval over {} placements, 95 % for four kinds together",
                               rarest.outcomes.size()));
  verdict.scenes = {"two flat convex occluders"};
  verdict.explanation = fmt::format(
      "Two convex occluders of one kind beside each other, 2 to 6 px apart and larger than what they move by "
      "against the background, wholly inside the four frustums: share of random placements that leave a "
      "block of at least 3 × 3 px {} in one of five positions, for the kind of four that does so least often "
      "({}): {}. The threshold is the one in twenty under which single convex occluders count as never "
      "failing (A-G4a). That it happens at all, for every kind, is another matter: the smallest number of "
      "such placements of a kind is {} of {}.",
      by == UnseenBy::kGeometry ? "truly hidden from all key views" : "that synthesis takes from no key view",
      rarest.name, interval_text(share), unseen_of(rarest, by), rarest.outcomes.size());
  return verdict;
}

std::string shares_text(const std::vector<OccluderStudy>& studies, UnseenBy by) {
  std::string text;
  for (const OccluderStudy& study : studies)
    text += fmt::format("{}{} {} of {}", text.empty() ? "" : ", ", study.name, unseen_of(study, by),
                        study.outcomes.size());
  return text;
}

}  // namespace

ReproductionResult reproduce_claim_g5(Laboratory& laboratory) {
  ReproductionResult result;
  const auto studies = study_occluders(laboratory, convex_shapes(), place_pair,
                                       placements_per_kind(laboratory, kPlacements), 0x4750);
  const auto geometry = study_geometry(laboratory, convex_shapes(), place_pair,
                                       placements_per_kind(laboratory, kGeometryPlacements), 0x4751);
  result.paper_shows =
      "With several occluders unseen points appear whatever their shape, because background between two of "
      "them can be hidden by one in some key views and by the other in the rest (sections 4.1.5, "
      "6.1.1: holes in the foliage).";
  result.ours_shows = fmt::format(
      "Two neighbouring convex occluders leave background that synthesis takes from no key view in these "
      "placements: {}. By geometry alone a block of 3 × 3 px is hidden from all key views in these: {}.",
      shares_text(studies, UnseenBy::kSynthesis), shares_text(geometry, UnseenBy::kGeometry));
  result.differs =
      "Our occluders stand close together and are larger than their displacement between key views; far "
      "apart or small they act as single ones. " +
      causes_text(mean_causes(studies));
  add_study(result, studies, "two convex");
  add_geometry_study(result, geometry, "two convex");
  result.add_plot("unseen-by-shape", plot_of(studies, geometry,
                                             "Two convex occluders side by side: share of placements that "
                                             "leave unseen background, with 95 % Wilson intervals"));
  add_worst_case(result, studies, "two-occluders", laboratory.options().threads);
  conclude(result,
           {"A-G5a", "Altmeier 2018, sections 4.1.5 and 6.1.1",
            "Several occluders hide points from all key views whatever their shape."},
           decide_any_shape(geometry, UnseenBy::kGeometry));
  conclude(result,
           {"A-G5b", "Altmeier 2018, sections 4.1.5 and 6.1.1",
            "Several occluders leave points unseen in synthesis whatever their shape."},
           decide_any_shape(studies, UnseenBy::kSynthesis));
  return result;
}

}  // namespace plenolab
