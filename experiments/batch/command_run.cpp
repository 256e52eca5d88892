#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "experiments/batch/commands.h"
#include "experiments/batch/outputs.h"
#include "experiments/batch/run.h"
#include "experiments/batch/study_folder.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/stop_signals.h"

namespace plenolab {

namespace {

struct RunOptions : BatchOptions {
  std::string out, shard = "1/1", cache;
};

BatchTally run_with_bar(const BatchPlan& plan, const RunOptions& options) {
  ProgressBar bar("batch");
  BatchRun run;
  run.folder = options.out;
  run.cache = render_cache_folder(options.cache);
  run.shard = parse_shard(options.shard);
  run.threads = options.common.threads;
  run.progress = bar.callback();
  run.on_stage = [&](const std::string& stage) { bar.remark(stage); };
  run.on_other_run = [&] {
    bar.clear();
    fmt::print(stderr,
               "plenolab: another run is at work in {}: what it computes is taken from it, and times of both "
               "suffer\n",
               options.out);
  };
  run.on_damaged = [&](const std::string& title) {
    bar.clear();
    fmt::print(stderr, "plenolab: the stored result of {} is damaged and is computed again\n", title);
  };
  return run_batch(plan, run);
}

std::string tally_text(const BatchTally& tally) {
  std::string text = fmt::format("{} items: {} were there, {} computed, {} failed", tally.items, tally.there,
                                 tally.computed - tally.failed, tally.failed);
  if (tally.shared > 0)
    text += fmt::format(", {} share the result of another with the same input and settings", tally.shared);
  return text;
}

void require_none_failed(const BatchTally& tally, const std::string& folder) {
  if (tally.failed > 0)
    throw InputError(
        fmt::format("{} of {} items of this shard failed: 'plenolab batch plan' with -o {} and "
                    "--csv - names them",
                    tally.failed, tally.items, folder));
}

void run_batch_command(const Invocation& invocation, const RunOptions& options, const CLI::App& app) {
  const BatchShard shard = parse_shard(options.shard);
  const BatchPlan plan = plan_of(options, app);
  claim_study_folder(options.out, options.study, options.force);
  Provenance provenance = begin_batch(invocation, options, plan);
  provenance.parameters["shard"] = options.shard;
  remove_outdated_outputs(plan, options.out, options.common);
  say_on_stop(
      fmt::format("the results so far are kept in {}, and the same command goes on with them", options.out));
  const BatchTally tally = run_with_bar(plan, options);
  tell(options.common, tally_text(tally));
  const std::vector<StoredItem> stored = read_items(plan, options.out);
  const auto open = std::count_if(stored.begin(), stored.end(), is_open);
  if (open == 0) return finish_batch(plan, stored, options.out, provenance, options.common);
  PLENOLAB_CHECK(!shard.whole(), fmt::format("{} items", open));
  tell(options.common, fmt::format("{} items of other shards are missing: 'plenolab batch merge' joins "
                                   "folders, and the last shard in one folder writes the report",
                                   open));
  write_results(batch_rows(plan, stored), provenance, options.common);
  require_none_failed(tally, options.out);
}

}  // namespace

void add_batch_run(CLI::App& batch, const Invocation& invocation) {
  CLI::App& app = *batch.add_subcommand("run", "Compute what is not there yet, and write tables and report");
  auto options = std::make_shared<RunOptions>();
  add_batch_options(app, *options);
  add_force_option(app, options->force);
  app.add_option("-o,--out", options->out, "Folder of results; those that are there are kept")
      ->required()
      ->check(not_empty());
  app.add_option("--shard", options->shard, "Compute only part I of N, written I/N, e.g. one on each machine")
      ->capture_default_str();
  app.add_option("--cache", options->cache, "Folder of rendered views (default ~/.cache/plenolab)")
      ->check(not_empty());
  app.footer(
      "Stopped or killed, the same command goes on where it was.\n"
      "Examples: plenolab batch run study.json -o results/study\n"
      "          plenolab batch run study.json -o results/part-2 --shard 2/4");
  app.callback([options, &app, &invocation] { run_batch_command(invocation, *options, app); });
}

}  // namespace plenolab
