#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "experiments/batch/commands.h"
#include "experiments/batch/outputs.h"
#include "experiments/batch/run.h"
#include "experiments/batch/summary.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/wide_table.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// The first quantity of each metric.
std::vector<WideColumn> columns_for_people(const BatchPlan& plan) {
  std::vector<WideColumn> columns{{"items", "items"}};
  for (const Metric* metric : plan.metrics)
    columns.push_back({metric->quantities.front().name, metric->quantities.front().name});
  columns.push_back({"ms_per_megapixel", "ms/megapixel"});
  return columns;
}

}  // namespace

void add_batch_options(CLI::App& app, BatchOptions& options) {
  app.add_option("study", options.study, "Study file")->required()->check(not_empty());
  add_common_options(app, options.common);
}

BatchPlan plan_of(const BatchOptions& options, const CLI::App& app) {
  BatchPlan plan = plan_batch(options.study, options.common.seed);
  if (plan.study.seed && app.count("--seed") > 0)
    throw UsageError(fmt::format("--seed: {} has a seed of its own, {}: change it there", options.study,
                                 *plan.study.seed));
  return plan;
}

Provenance begin_batch(const Invocation& invocation, const BatchOptions& options, const BatchPlan& plan) {
  Provenance provenance = begin_run(invocation, options.common);
  provenance.seed = plan.seed;
  add_input(provenance, options.study);
  for (const BatchInput& input : plan.inputs)
    if (!input.content.empty())
      provenance.inputs.push_back({input.path.empty()
                                       ? fmt::format("scene {} {}", input.choice.source, input.choice.preset)
                                       : input.path.string(),
                                   input.content});
  return provenance;
}

void remove_outdated_outputs(const BatchPlan& plan, const fs::path& folder, const CommonOptions& options) {
  const std::vector<StoredItem> stored = read_items(plan, folder);
  const auto open = std::count_if(stored.begin(), stored.end(), is_open);
  if (open == 0) return;
  if (const std::string removed = remove_earlier_outputs(folder); !removed.empty())
    tell(options, fmt::format("removed {} of an earlier study from {}: {} of {} items of this one are not "
                              "there yet; results of items are kept",
                              removed, folder.string(), open, stored.size()));
}

void finish_batch(const BatchPlan& plan, const std::vector<StoredItem>& stored, const fs::path& folder,
                  Provenance& provenance, const CommonOptions& options) {
  const auto failed = std::count_if(stored.begin(), stored.end(),
                                    [](const StoredItem& item) { return item.state == ItemState::kFailed; });
  provenance.parameters["items"] = static_cast<long long>(stored.size());
  provenance.parameters["items_failed"] = static_cast<long long>(failed);
  write_batch_outputs(plan, stored, folder, provenance);
  if (!output_is_for_programs(options)) {
    fmt::print("{}", to_wide_text(operator_rows(plan, stored), {"operator"}, columns_for_people(plan)));
    for (const auto& notes : {comparison_notes(plan, stored), exposure_notes(plan, stored)})
      for (const std::string& note : notes) fmt::print("{}\n", note);
  }
  write_results(batch_rows(plan, stored), provenance, options);
  tell(options, fmt::format("wrote results.csv, timings.csv and report.html to {}", folder.string()));
  if (failed > 0)
    throw InputError(
        fmt::format("{} of {} items failed: {}", failed, stored.size(), failures_text(plan, stored)));
}

void add_batch_command(CLI::App& app, const Invocation& invocation);

void add_batch_command(CLI::App& app, const Invocation& invocation) {
  app.require_subcommand(1);
  add_batch_plan(app, invocation);
  add_batch_run(app, invocation);
  add_batch_merge(app, invocation);
  app.footer(
      "Examples: plenolab batch plan study.json\n"
      "          plenolab batch run study.json -o results/study\n"
      "'plenolab batch run --help' explains a command; experiments/batch/README.md explains the study file.");
}

}  // namespace plenolab
