#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>

#include "experiments/batch/commands.h"
#include "experiments/batch/run.h"
#include "experiments/batch/summary.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/wide_table.h"

namespace plenolab {

namespace {

struct PlanOptions : BatchOptions {
  std::string out;
};

const char* name_of(const BatchItem& item, const StoredItem& stored) {
  switch (stored.state) {
    case ItemState::kDone:
      return "done";
    case ItemState::kFailed:
      return "failed";
    case ItemState::kDamaged:
      return "damaged";
    case ItemState::kIncomplete:
      return "metrics to do";
    case ItemState::kMissing:
      break;
  }
  return item.problem.empty() ? "to do" : "cannot be done";
}

/// One row an item: 1 if it is done.
ResultTable item_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const BatchItem& item = plan.items[i];
    Columns columns = plan.columns(item);
    columns.emplace_back("state", std::string(name_of(item, stored[i])));
    columns.emplace_back("key", item.key);
    const std::string failures = stored[i].result.failures();
    columns.emplace_back("note", failures.empty() ? plan.problems_of(item) : failures);
    table.add({"done", stored[i].state == ItemState::kDone ? 1.0 : 0.0, "1", columns});
  }
  return table;
}

/// Items of each input by state.
ResultTable input_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t input = 0; input < plan.inputs.size(); ++input) {
    const BatchInputChoice& choice = plan.inputs[input].choice;
    const Columns columns{{"input", choice.title()}, {"preset", choice.preset}};
    int items = 0, done = 0, failed = 0;
    for (std::size_t i = 0; i < plan.items.size(); ++i) {
      if (plan.items[i].input != input) continue;
      ++items;
      done += stored[i].state == ItemState::kDone ? 1 : 0;
      failed += stored[i].state == ItemState::kFailed ? 1 : 0;
    }
    table.add({"items", static_cast<double>(items), "1", columns});
    table.add({"items_done", static_cast<double>(done), "1", columns});
    table.add({"items_failed", static_cast<double>(failed), "1", columns});
  }
  return table;
}

/// What is known to fail, and for how many items.
std::map<std::string, int> known_problems(const BatchPlan& plan) {
  std::map<std::string, int> problems;
  for (const BatchItem& item : plan.items)
    if (const std::string problem = plan.problems_of(item); !problem.empty()) {
      const std::string title = title_of(plan.inputs[item.input]);
      ++problems[(problem.starts_with(title) ? "" : title + ": ") + problem];
    }
  return problems;
}

struct Rest {
  std::size_t items = 0;          ///< that are not done
  std::optional<double> seconds;  ///< nothing if no item is done yet
};

/// Items take as long as those with the same input did, else as all did on average; loading is not counted.
Rest rest_of(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  struct Sum {
    double seconds = 0, items = 0;
  };
  std::map<std::size_t, Sum> of_input;
  Sum all;
  for (std::size_t i = 0; i < plan.items.size(); ++i)
    if (stored[i].state == ItemState::kDone)
      for (Sum* sum : {&of_input[plan.items[i].input], &all})
        sum->seconds += stored[i].result.seconds_with_metrics(), sum->items += 1;
  Rest rest;
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    if (stored[i].state == ItemState::kDone) continue;
    ++rest.items;
    if (all.items == 0) continue;
    const auto own = of_input.find(plan.items[i].input);
    const Sum& sum = own == of_input.end() ? all : own->second;
    rest.seconds = rest.seconds.value_or(0) + sum.seconds / sum.items;
  }
  return rest;
}

std::string rest_text(const BatchPlan& plan, const Rest& rest) {
  std::string text = fmt::format("{} items, {} to do", plan.items.size(), rest.items);
  if (rest.seconds)
    text += fmt::format(", about {} of work without rendering and reading", format_duration(*rest.seconds));
  return text;
}

void run_plan(const Invocation& invocation, const PlanOptions& options, const CLI::App& app) {
  const BatchPlan plan = plan_of(options, app);
  Provenance provenance = begin_batch(invocation, options, plan);
  const std::vector<StoredItem> stored =
      options.out.empty() ? std::vector<StoredItem>(plan.items.size()) : read_items(plan, options.out);
  const Rest rest = rest_of(plan, stored);
  if (!output_is_for_programs(options.common)) {
    fmt::print("{}", to_wide_text(input_rows(plan, stored), {"input", "preset"},
                                  {{"items", "items"}, {"items_done", "done"}, {"items_failed", "failed"}}));
    for (const auto& [problem, items] : known_problems(plan))
      fmt::print("{} item{} cannot be done, wholly or in part: {}\n", items, items == 1 ? "" : "s", problem);
    fmt::print("{}\n", rest_text(plan, rest));
  }
  ResultTable rows = item_rows(plan, stored);
  rows.add({"items", static_cast<double>(plan.items.size()), "1", {}});
  rows.add({"items_to_do", static_cast<double>(rest.items), "1", {}});
  if (rest.seconds) rows.add({"seconds_to_do", *rest.seconds, "s", {}});
  write_results(rows, provenance, options.common);
}

}  // namespace

void add_batch_plan(CLI::App& batch, const Invocation& invocation) {
  CLI::App& app =
      *batch.add_subcommand("plan", "What a study comes to: its items, and which of them are done");
  auto options = std::make_shared<PlanOptions>();
  add_batch_options(app, *options);
  app.add_option("-o,--out", options->out, "Folder of results, where items may be done already")
      ->check(not_empty());
  app.footer("Example: plenolab batch plan study.json -o results/study");
  app.callback([options, &app, &invocation] { run_plan(invocation, *options, app); });
}

}  // namespace plenolab
