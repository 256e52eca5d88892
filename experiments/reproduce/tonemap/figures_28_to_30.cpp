// Figures 28 to 30: two neighbouring key views, mapped naively, with joint statistics, and adjusted.
#include <fmt/format.h>

#include <cmath>

#include "experiments/reproduce/tonemap/pair_figure.h"

namespace plenolab {

ReproductionResult reproduce_naive_neighbours(Laboratory& laboratory);
ReproductionResult reproduce_joint_neighbours(Laboratory& laboratory);
ReproductionResult reproduce_adjusted_neighbours(Laboratory& laboratory);

namespace {

constexpr const char* kNothing =
    "No pair of key views in this run shows enough surfaces under the same light.";

/// "Cellar and Desk": the scenes whose change with a mapping reaches one step of an 8-bit display, or not.
std::string scenes_that_change(const std::vector<ShownPair>& pairs, std::size_t mapping, bool change) {
  std::string text;
  for (const ShownPair& shown : pairs)
    if ((std::abs(shown.changes[mapping].mean) >= kSmallestStep) == change)
      text += (text.empty() ? "" : ", ") + shown.pair.title;
  return text;
}

/// Mean over the pairs of |mean change| with the last mapping over that with the first.
double remaining_share(const std::vector<ShownPair>& pairs) {
  double before = 0, after = 0;
  for (const ShownPair& shown : pairs) {
    before += std::abs(shown.changes.front().mean);
    after += std::abs(shown.changes.back().mean);
  }
  return before > 0 ? after / before : 0;
}

/// Shows the pairs with the naive variant and another mapping and says what is left of the change.
void show_remedy(ReproductionResult& result, MappingBench& bench, Shown remedy, bool factor,
                 const std::string& name) {
  const std::vector<ShownPair> pairs =
      show_pairs(result, bench, most_changed_pairs(bench), {{Shown::kReinhardNaive, remedy}, factor});
  if (pairs.empty()) {
    result.ours_shows = kNothing;
    result.differs = "Nothing can be compared.";
    return;
  }
  result.ours_shows = fmt::format(
      "Change of luma from the first key view to the second: {} naively, {} {}. Of the mean change {:.1f} % "
      "are "
      "left.",
      change_words(pairs, 0), change_words(pairs, 1), name, 100 * remaining_share(pairs));
  const std::string left = scenes_that_change(pairs, 1, true);
  result.differs = left.empty() ? "They agree: no mean change reaches one step of an 8-bit display."
                                : fmt::format(
                                      "They differ: the mean change still exceeds one step of an 8-bit "
                                      "display in {}.",
                                      left);
}

}  // namespace

ReproductionResult reproduce_naive_neighbours(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  result.paper_shows =
      "Figure 28: mapped one by one by Reinhard 2005, two neighbouring key views differ visibly, although no "
      "light "
      "changes: outliers decide the extremes. A light source that appears or is hidden does the same.";
  const std::vector<ShownPair> pairs =
      show_pairs(result, bench, most_changed_pairs(bench), {{Shown::kReinhardNaive}, false});
  if (pairs.empty()) {
    result.ours_shows = kNothing;
    result.differs = "Nothing can be compared.";
    return result;
  }
  result.ours_shows =
      "Of all neighbouring key views, these change most (mean luma of surfaces under the same light): " +
      change_words(pairs, 0) + ".";
  for (const ShownPair& shown : pairs)
    result.ours_shows += fmt::format(" {}: peak luminance changes by {:+.2f} log10 units.", shown.pair.title,
                                     shown.pair.naive.log_peak_step);
  const std::string visible = scenes_that_change(pairs, 0, true),
                    hidden = scenes_that_change(pairs, 0, false);
  if (!visible.empty())
    result.differs =
        fmt::format("They agree on {}: the change exceeds one step of an 8-bit display.", visible);
  if (!hidden.empty())
    result.differs += fmt::format("{}They differ on {}: the change is less than one step.",
                                  visible.empty() ? "" : " ", hidden);
  return result;
}

ReproductionResult reproduce_joint_neighbours(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 29: with statistics of all key views and limits set by hand, the same two key views look "
      "alike.";
  show_remedy(result, laboratory.mapping_bench(), Shown::kReinhardJoint, false, "jointly");
  return result;
}

ReproductionResult reproduce_adjusted_neighbours(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 30: key-view adjustment greatly reduces the differences between the two key views and leaves "
      "no "
      "visible artefacts in them.";
  show_remedy(result, laboratory.mapping_bench(), Shown::kReinhardAdjusted, true, "adjusted");
  return result;
}

}  // namespace plenolab
