#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "core/base/error.h"
#include "experiments/batch/commands.h"
#include "experiments/batch/outputs.h"
#include "experiments/batch/picture.h"
#include "experiments/batch/run.h"
#include "experiments/batch/study_folder.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/result_folder.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct MergeOptions : BatchOptions {
  std::vector<std::string> folders;
  std::string out;
};

/// What the folders have of an item, the first first: the mapping of one and the metrics of all.
StoredItem find_item(const std::vector<std::string>& folders, const BatchPlan& plan, const BatchItem& item) {
  StoredItem found;
  for (const std::string& folder : folders) complete(plan, item, found, read_item(folder, plan, item));
  return found;
}

/// Takes what the folder of all results lacks from the others. Returns what it has of each item then.
std::vector<StoredItem> gather(const BatchPlan& plan, const MergeOptions& options, std::size_t& there) {
  std::vector<std::string> folders{options.out};
  folders.insert(folders.end(), options.folders.begin(), options.folders.end());
  std::vector<StoredItem> stored;
  for (const BatchItem& item : plan.items) {
    const bool is_there = read_item(options.out, plan, item).state == ItemState::kDone;
    there += is_there ? 1 : 0;
    stored.push_back(find_item(folders, plan, item));
    for (const std::string& folder : options.folders) copy_pictures(folder, options.out, plan, item);
    if (!is_there && stored.back().state >= ItemState::kIncomplete)
      write_item(options.out, plan, item, stored.back().result);
  }
  return stored;
}

/// Why no folder has a result of an item.
enum class Gap { kMissing, kDamaged, kIncomplete, kOtherBuild, kOtherSettings };

const char* text_of(Gap gap) {
  switch (gap) {
    case Gap::kDamaged:
      return "damaged";
    case Gap::kIncomplete:
      return "there without some metrics of this study";
    case Gap::kOtherBuild:
      return "there from another build of plenolab only, whose sources or compiler differ";
    case Gap::kOtherSettings:
      return "there only for other pixels or a study with other units or repeats";
    case Gap::kMissing:
      break;
  }
  return "missing";
}

/// Titles of results of the folders that are of no item of the plan, and whether this build computed them.
std::map<std::string, bool> other_titles(const std::vector<std::string>& folders, const BatchPlan& plan) {
  std::map<std::string, bool> titles;
  for (const std::string& folder : folders)
    for (const ItemLabel& label : other_items(folder, plan)) {
      bool& of_this_build = titles.try_emplace(label.title, false).first->second;
      of_this_build = of_this_build || label.is_of_this_build;
    }
  return titles;
}

using Gaps = std::map<Gap, std::vector<std::string>>;

/// Titles of the items that have no result.
Gaps find_gaps(const BatchPlan& plan, const std::vector<StoredItem>& stored,
               const std::vector<std::string>& folders) {
  Gaps gaps;
  if (std::none_of(stored.begin(), stored.end(), is_open)) return gaps;
  const std::map<std::string, bool> others = other_titles(folders, plan);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (!is_open(stored[i])) continue;
    const std::string title = plan.title(plan.items[i]);
    const auto other = others.find(title);
    Gap gap = stored[i].state == ItemState::kDamaged      ? Gap::kDamaged
              : stored[i].state == ItemState::kIncomplete ? Gap::kIncomplete
                                                          : Gap::kMissing;
    if (gap == Gap::kMissing && other != others.end())
      gap = other->second ? Gap::kOtherSettings : Gap::kOtherBuild;
    gaps[gap].push_back(title);
  }
  return gaps;
}

/// For each reason the first items, then how many more there are.
std::string gaps_text(const Gaps& gaps, std::size_t items) {
  constexpr std::size_t kMostNamed = 5;
  std::string text;
  for (const auto& [gap, titles] : gaps) {
    text += fmt::format("{}{} of {} items are {}: ", text.empty() ? "" : "; ", titles.size(), items,
                        text_of(gap));
    for (std::size_t i = 0; i < std::min(kMostNamed, titles.size()); ++i)
      text += (i == 0 ? "" : "; ") + titles[i];
    if (titles.size() > kMostNamed) text += fmt::format("; and {} more", titles.size() - kMostNamed);
  }
  return text;
}

void require_results(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) throw InputError(fmt::format("{} does not exist", folder));
  if (!fs::is_directory(folder, error)) throw InputError(fmt::format("{} is not a folder", folder));
  if (!fs::is_directory(fs::path(folder) / kItemsFolder, error))
    throw InputError(
        fmt::format("{} holds no results of a batch: it has no folder {}", folder, kItemsFolder));
}

void run_merge(const Invocation& invocation, const MergeOptions& options, const CLI::App& app) {
  for (const std::string& folder : options.folders) require_results(folder);
  const BatchPlan plan = plan_of(options, app);
  claim_study_folder(options.out, options.study, options.force);
  Provenance provenance = begin_batch(invocation, options, plan);
  remove_outdated_outputs(plan, options.out, options.common);
  std::size_t there = 0;
  const std::vector<StoredItem> stored = gather(plan, options, there);
  if (there > 0) tell(options.common, fmt::format("kept {} results that were in {}", there, options.out));
  if (const Gaps gaps = find_gaps(plan, stored, options.folders); !gaps.empty())
    throw InputError(fmt::format("{}; 'plenolab batch run' with -o {} computes them",
                                 gaps_text(gaps, stored.size()), options.out));
  finish_batch(plan, stored, options.out, provenance, options.common);
}

}  // namespace

void add_batch_merge(CLI::App& batch, const Invocation& invocation) {
  CLI::App& app = *batch.add_subcommand("merge", "Join the results of shards, and write tables and report");
  auto options = std::make_shared<MergeOptions>();
  add_batch_options(app, *options);
  add_force_option(app, options->force);
  app.add_option("folders", options->folders, "Folders of results")->required()->check(not_empty());
  app.add_option("-o,--out", options->out, "Folder for all results")->required()->check(not_empty());
  app.footer("Example: plenolab batch merge study.json results/part-1 results/part-2 -o results/study");
  app.callback([options, &app, &invocation] { run_merge(invocation, *options, app); });
}

}  // namespace plenolab
