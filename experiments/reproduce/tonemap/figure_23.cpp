// Figure 23 (section 5.1.3): a low-contrast edge where only the base layer is changed.
#include <fmt/format.h>

#include "experiments/reproduce/tonemap/edge_profile.h"

namespace plenolab {

ReproductionResult reproduce_edge_without_foreground(Laboratory& laboratory);

ReproductionResult reproduce_edge_without_foreground(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 23 shows that the disparity weight alone leaves no profile at the edge, and compresses the "
      "contrast between foreground and background with the base. No numbers.";
  const int threads = laboratory.options().threads;
  const EdgeProfile edge = trace_edge(EdgeOperator::kWithoutForeground, threads);
  const EdgeProfile naive = trace_edge(EdgeOperator::kNaive, threads);
  add_edge(result, edge, "without-foreground",
           "Enhanced operator with foreground scale 0: layers and result of a step of 0.2 log10 units on a "
           "depth edge, compression 0.4");
  result.ours_shows = fmt::format(
      "Of the step of {:.3f} log10 units the result has {:.3f} at the edge, as much as far from it ({:.3f}); "
      "the "
      "naive operator keeps {:.3f}. The profiles are {:+.4f} on the foreground and {:+.4f} on the "
      "background.",
      edge.input_step(), edge.target_step(), edge.target_level(), naive.target_step(),
      edge.foreground_profile(), edge.background_profile());
  result.differs = edge.target_step() < naive.target_step()
                       ? fmt::format(
                             "They agree: the edge keeps {:.0f} % of the contrast that it has with the naive "
                             "operator.",
                             100 * edge.target_step() / naive.target_step())
                       : "They differ: the contrast at the edge does not fall.";
  return result;
}

}  // namespace plenolab
