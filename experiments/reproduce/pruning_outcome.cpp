#include "experiments/reproduce/pruning_outcome.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/score.h"

namespace plenolab {

namespace {

/// Each stage once, also where it was left out for several key views.
std::string stage_names(const PruningOutcome& outcome) {
  std::vector<std::string> names;
  for (const PrunedStage& stage : outcome.stages)
    if (std::find(names.begin(), names.end(), stage.stage) == names.end()) names.push_back(stage.stage);
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_outcome_rows(ResultTable& rows, const PruningOutcome& o) {
  const Columns columns{{"part", o.part}, {"stimulus", o.stimulus}};
  rows.add({"equal_with_and_without", o.equal ? 1.0 : 0.0, "1", columns});
  rows.add({"seconds_pruned", o.seconds_pruned, "s", columns});
  rows.add({"seconds_full", o.seconds_full, "s", columns});
  for (const PrunedStage& stage : o.stages) {
    Columns with_stage = columns;
    with_stage.emplace_back("stage", stage.stage);
    with_stage.emplace_back("reason", stage.reason);
    rows.add({"stage_left_out", 1, "1", with_stage});
  }
}

ReportTable reasons_table(const std::vector<PruningOutcome>& outcomes) {
  ReportTable table{"What was left out and why", {"part", "stimulus", "stage", "reason"}, {}};
  for (const PruningOutcome& o : outcomes)
    for (const PrunedStage& stage : o.stages)
      table.rows.push_back({o.part, o.stimulus, stage.stage, stage.reason});
  return table;
}

ReportTable savings_table(const std::vector<PruningOutcome>& outcomes) {
  ReportTable table{"Time with and without leaving out; results compared bit by bit",
                    {"part", "stimulus", "left out", "with [ms]", "without [ms]", "saved [%]", "equal"},
                    {}};
  for (const PruningOutcome& o : outcomes)
    table.rows.push_back({o.part, o.stimulus, stage_names(o), o.seconds_pruned * 1000, o.seconds_full * 1000,
                          o.seconds_full > 0 ? 100 * (1 - o.seconds_pruned / o.seconds_full) : 0.0,
                          std::string(o.equal ? "yes" : "NO")});
  table.digits = 3;
  return table;
}

}  // namespace plenolab
