// Figure 21 (section 5.1.2): a low-contrast edge through the naive bilateral operator.
#include <fmt/format.h>

#include <cmath>

#include "experiments/reproduce/tonemap/edge_profile.h"

namespace plenolab {

ReproductionResult reproduce_naive_edge(Laboratory& laboratory);

ReproductionResult reproduce_naive_edge(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 21 shows how the naive operator splits a low-contrast edge into base and detail: both sides of "
      "the edge get a Cornsweet profile, which keeps the contrast of the edge although the base is "
      "compressed. No numbers.";
  const EdgeProfile edge = trace_edge(EdgeOperator::kNaive, laboratory.options().threads);
  add_edge(result, edge, "naive",
           "Naive bilateral operator: layers and result of a step of 0.2 log10 units on a depth edge, "
           "compression 0.4");
  result.ours_shows = fmt::format(
      "Of the step of {:.3f} log10 units the result has {:.3f} at the edge, though the levels far from it "
      "differ by {:.3f} only. The profile raises the foreground by {:+.3f} and changes the background by "
      "{:+.3f} "
      "beside the edge.",
      edge.input_step(), edge.target_step(), edge.target_level(), edge.foreground_profile(),
      edge.background_profile());
  const double foreground = edge.foreground_profile(), background = edge.background_profile();
  result.differs =
      foreground > 0 && background < 0
          ? fmt::format(
                "They agree. The {} on the background is the one that section 5.1.2 "
                "blames: in another key view it lies elsewhere.",
                std::abs(background + foreground) < 0.1 * foreground ? "equally large half of the profile"
                                                                     : "half of the profile")
          : "They differ: the profile does not lie on both sides of the edge.";
  return result;
}

}  // namespace plenolab
