#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// How the items of a batch are computed.
struct BatchRun {
  std::filesystem::path folder;  ///< of the results
  std::filesystem::path cache;   ///< of rendered views
  BatchShard shard;
  int threads = 0;
  Progress progress;                                   ///< of the items that are to be computed
  std::function<void(const std::string&)> on_stage;    ///< what is done now
  std::function<void(const std::string&)> on_damaged;  ///< an item's file that is computed again
  std::function<void()> on_other_run;                  ///< the first item that another run is at
};

/// What a run found and did, in items of its shard.
struct BatchTally {
  std::size_t items = 0;
  std::size_t there = 0;     ///< with a result from before, or that another run has stored meanwhile
  std::size_t shared = 0;    ///< with the key of one before them in the shard, e.g. of an input given twice
  std::size_t computed = 0;  ///< tried, and failed perhaps
  std::size_t failed = 0;
};

/// Sweeps up what killed runs left half written, then computes every item of the shard that is not there yet,
/// input by input, so that each input is rendered or read once, and stores each as soon as it is known. Items
/// that fail are stored as such and do not stop the others. Timed mapping has the machine for itself; the
/// metrics of small images run side by side, those of large ones one after the other on all threads. Results
/// do not depend on threads, shards or interruptions. Of an item that is mapped already only the missing
/// metrics are computed, and its times stay. Items that another run in the folder is at come last, and are
/// not computed if that one stores them. Throws InputError if a result cannot be written.
BatchTally run_batch(const BatchPlan& plan, const BatchRun& run);

/// What stands on disk for each item of the plan, in its order.
std::vector<StoredItem> read_items(const BatchPlan& plan, const std::filesystem::path& folder);

}  // namespace plenolab
