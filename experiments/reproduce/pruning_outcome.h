#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/timing.h"
#include "core/base/pruned_stage.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// What the items on leaving out share.

/// What leaving out did to one result.
struct PruningOutcome {
  std::string part, stimulus;
  std::vector<PrunedStage> stages;
  bool equal = false;
  double seconds_pruned = 0, seconds_full = 0;
};

/// Runs `work(true)` and `work(false)`, with and without leaving out, by turns, so that a change of the
/// machine's speed meets both; fills in the median times and returns the last two results.
template <class Work>
auto time_by_turns(PruningOutcome& outcome, const Work& work, int runs = 3) {
  std::array<std::vector<double>, 2> seconds;
  std::array<decltype(work(true)), 2> results;
  for (int run = 0; run < runs; ++run)
    for (const std::size_t full : {0u, 1u}) {
      const Stopwatch watch;
      results[full] = work(full == 0);
      seconds[full].push_back(watch.seconds());
    }
  outcome.seconds_pruned = summarise_times(seconds[0]).median_s;
  outcome.seconds_full = summarise_times(seconds[1]).median_s;
  return results;
}

void add_outcome_rows(ResultTable& rows, const PruningOutcome& outcome);
/// What was left out of each result, and why.
ReportTable reasons_table(const std::vector<PruningOutcome>& outcomes);
/// Both times of each result, and whether it is the same.
ReportTable savings_table(const std::vector<PruningOutcome>& outcomes);

}  // namespace plenolab
