#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "experiments/batch/commands.h"
#include "experiments/batch/run.h"
#include "experiments/cli/checks.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct MergeOptions : BatchOptions {
  std::vector<std::string> folders;
  std::string out;
};

/// The best that any of the folders has of an item.
StoredItem find_item(const std::vector<std::string>& folders, const BatchItem& item) {
  StoredItem best;
  for (const std::string& folder : folders)
    if (StoredItem found = read_item(folder, item); found.state > best.state) best = std::move(found);
  return best;
}

/// The first missing ones, then how many more there are.
std::string missing_text(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  constexpr int kMostNamed = 5;
  std::string text;
  int missing = 0;
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (stored[i].state < ItemState::kFailed && ++missing <= kMostNamed)
      text += (text.empty() ? "" : "; ") + plan.title(plan.items[i]);
  if (missing > kMostNamed) text += fmt::format("; and {} more", missing - kMostNamed);
  return missing == 0 ? "" : fmt::format("{} of {} items are missing: {}", missing, stored.size(), text);
}

void run_merge(const Invocation& invocation, const MergeOptions& options, const CLI::App& app) {
  for (const std::string& folder : options.folders)
    if (!fs::is_directory(fs::path(folder) / "items"))
      throw InputError(fmt::format("{} holds no results of a batch", folder));
  require_batch_folder(options.out);
  const BatchPlan plan = plan_of(options, app);
  Provenance provenance = begin_batch(invocation, options, plan);
  std::vector<StoredItem> stored;
  for (const BatchItem& item : plan.items) {
    stored.push_back(find_item(options.folders, item));
    if (stored.back().state >= ItemState::kFailed) write_item(options.out, plan, item, stored.back().result);
  }
  if (const std::string missing = missing_text(plan, stored); !missing.empty())
    throw InputError(fmt::format("{}; 'plenolab batch run' with -o {} computes them", missing, options.out));
  finish_batch(plan, stored, options.out, provenance, options.common);
}

}  // namespace

void add_batch_merge(CLI::App& batch, const Invocation& invocation) {
  CLI::App& app = *batch.add_subcommand("merge", "Join the results of shards, and write tables and report");
  auto options = std::make_shared<MergeOptions>();
  add_batch_options(app, *options);
  app.add_option("folders", options->folders, "Folders of results")->required()->check(not_empty());
  app.add_option("-o,--out", options->out, "Folder for all results")->required()->check(not_empty());
  app.footer("Example: plenolab batch merge study.json results/part-1 results/part-2 -o results/study");
  app.callback([options, &app, &invocation] { run_merge(invocation, *options, app); });
}

}  // namespace plenolab
