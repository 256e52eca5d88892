#include "experiments/batch/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <set>
#include <span>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/stale_partials.h"
#include "experiments/batch/item_lock.h"
#include "experiments/batch/measure.h"
#include "experiments/batch/picture.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Images of more pixels are measured one after the other.
constexpr std::size_t kSmall_px = 512 * 512;
/// Mapped images that wait for their metrics, altogether.
constexpr std::size_t kMostWaiting_px = std::size_t{32} << 20;
/// Time for mapping before the metrics of what is mapped are measured and stored: what a kill can cost.
constexpr double kMostWaiting_s = 5;

/// Items to be computed, which all threads count down.
class Remaining {
 public:
  Remaining(const BatchPlan& plan, const BatchRun& run, std::size_t items)
      : locks(run.folder), plan_(plan), run_(run), items_(items) {}

  /// Stores a result with its pictures, and tells how far the run is.
  void finish(const BatchItem& item, MappedItem& mapped) {
    const BatchInput& input = plan_.inputs[item.input];
    mapped.result.failure = input.as_spelled(mapped.result.failure);
    for (MetricResult& metric : mapped.result.metrics) metric.failure = input.as_spelled(metric.failure);
    if (!mapped.image.empty()) write_pictures(run_.folder, plan_, item, mapped.image);
    write_item(run_.folder, plan_, item, mapped.result);
    count(item, mapped.result.failures().empty() ? 0 : 1);
    computed_ += 1;
  }
  void fail(const BatchItem& item, const std::string& failure) {
    MappedItem mapped;
    mapped.result = failed_result(failure);
    finish(item, mapped);
  }
  /// Another run has stored it meanwhile.
  void leave(const BatchItem& item) { count(item, 0); }

  std::size_t computed() const { return computed_; }
  std::size_t failed() const { return failed_; }

  ItemLocks locks;

 private:
  void count(const BatchItem& item, std::size_t failed) {
    locks.unlock(item.key);
    const std::lock_guard lock(mutex_);
    ++done_;
    failed_ += failed;
    if (run_.progress) run_.progress(static_cast<double>(done_) / static_cast<double>(items_));
  }

  const BatchPlan& plan_;
  const BatchRun& run_;
  std::mutex mutex_;
  std::size_t items_, done_ = 0, failed_ = 0;
  std::atomic<std::size_t> computed_ = 0;
};

void tell_stage(const BatchRun& run, const std::string& stage) {
  if (run.on_stage) run.on_stage(stage);
}

/// Whether nothing is to be done for an item.
bool is_done(const BatchPlan& plan, const BatchRun& run, const BatchItem& item, ItemState state) {
  return state == ItemState::kDone && has_pictures(run.folder, plan, item);
}

/// The items of the shard without a result; of several with one key the first, and the others are counted.
std::vector<std::size_t> items_to_compute(const BatchPlan& plan, const BatchRun& run, BatchTally& tally) {
  std::vector<std::size_t> missing;
  std::set<std::string> keys;
  for (const std::size_t index : items_of(run.shard, plan.items.size())) {
    const BatchItem& item = plan.items[index];
    ++tally.items;
    if (!keys.insert(item.key).second) {
      ++tally.shared;
      continue;
    }
    const ItemState state = read_item(run.folder, plan, item).state;
    if (is_done(plan, run, item, state)) continue;
    if (state == ItemState::kDamaged && run.on_damaged) run.on_damaged(plan.title(item));
    missing.push_back(index);
  }
  return missing;
}

/// What is made once for several items of an input, and a second time without timing, for items that are
/// timed already.
struct InputWork {
  SharedWork timed, again;
};

/// An item with what is stored of it: of one that is mapped already only the image is made again.
MappedItem map_stored(const BatchPlan& plan, const BatchRun& run, const BatchItem& item,
                      const LoadedInput& input, InputWork& work) {
  StoredItem stored = read_item(run.folder, plan, item);
  if (!stored.mapped()) return map_item(plan, item, input, work.timed, run.threads);
  MappedItem mapped = map_item(plan, item, input, work.again, run.threads);
  if (!mapped.result.failed()) mapped.result = std::move(stored.result);
  return mapped;
}

/// Items that are mapped and locked, and wait for their metrics.
struct Waiting {
  std::vector<std::size_t> items;
  std::vector<MappedItem> mapped;
};

/// Maps items from the front of the list on, one after the other, until all are or enough has been done that
/// is not stored. Those that another run is at are put off to `later`.
Waiting map_some(const BatchPlan& plan, std::span<const std::size_t>& items, const LoadedInput& input,
                 InputWork& work, const BatchRun& run, Remaining& remaining,
                 std::vector<std::size_t>& later) {
  Waiting waiting;
  std::size_t waiting_px = 0;
  const Stopwatch watch;
  while (!items.empty() && waiting_px < kMostWaiting_px && watch.seconds() <= kMostWaiting_s) {
    const std::size_t index = items.front();
    items = items.subspan(1);
    const BatchItem& item = plan.items[index];
    if (!remaining.locks.try_lock(item.key)) {
      if (later.empty() && run.on_other_run) run.on_other_run();
      later.push_back(index);
      continue;
    }
    if (is_done(plan, run, item, read_item(run.folder, plan, item).state)) {
      remaining.leave(item);
      continue;
    }
    tell_stage(run, "mapping " + plan.title(item));
    waiting.items.push_back(index);
    waiting.mapped.push_back(map_stored(plan, run, item, input, work));
    waiting_px += waiting.mapped.back().image.size();
  }
  return waiting;
}

void measure_all(const BatchPlan& plan, Waiting& waiting, int threads, Remaining& remaining) {
  std::vector<MappedItem>& mapped = waiting.mapped;
  const bool small = std::all_of(mapped.begin(), mapped.end(),
                                 [](const MappedItem& item) { return item.image.size() <= kSmall_px; });
  const bool side_by_side = small && mapped.size() > 1;
  parallel_for(static_cast<int>(mapped.size()), 1, side_by_side ? threads : 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const BatchItem& item = plan.items[waiting.items[i]];
      measure_item(plan, item, mapped[i], side_by_side ? 1 : threads);
      remaining.finish(item, mapped[i]);
      mapped[i] = {};
    }
  });
}

void fail_all(const BatchPlan& plan, std::span<const std::size_t> items, const std::string& failure,
              Remaining& remaining) {
  for (const std::size_t index : items) remaining.fail(plan.items[index], failure);
}

/// Those that nothing is known against; the others fail.
std::vector<std::size_t> without_problems(const BatchPlan& plan, std::span<const std::size_t> items,
                                          Remaining& remaining) {
  std::vector<std::size_t> good;
  for (const std::size_t index : items) {
    const BatchItem& item = plan.items[index];
    if (item.problem.empty())
      good.push_back(index);
    else
      remaining.fail(item, item.problem);
  }
  return good;
}

/// Renders or reads the input; if that fails, all of its items do.
std::unique_ptr<LoadedInput> load(const BatchPlan& plan, std::span<const std::size_t> items,
                                  const BatchRun& run, Remaining& remaining) {
  const BatchInput& input = plan.inputs[plan.items[items.front()].input];
  const std::string& title = input.choice.title();
  tell_stage(run, "loading " + title);
  const auto on_view = [&](const RenderingTally& tally) {
    tell_stage(run, fmt::format("loading {}, view {}", title, tally.rendered + tally.from_cache));
  };
  try {
    return std::make_unique<LoadedInput>(
        input,
        LoadInputOptions{.cache = run.cache, .seed = plan.seed, .threads = run.threads, .on_view = on_view});
  } catch (const std::bad_alloc&) {
    fail_all(plan, items, "out of memory", remaining);
  } catch (const std::exception& error) {
    fail_all(plan, items, error.what(), remaining);
  }
  return nullptr;
}

/// All items are of one input. Those that another run is at come into `later`.
void compute(const BatchPlan& plan, std::span<const std::size_t> all, const BatchRun& run,
             Remaining& remaining, std::vector<std::size_t>& later) {
  const std::vector<std::size_t> good = without_problems(plan, all, remaining);
  if (good.empty()) return;
  const std::unique_ptr<LoadedInput> input = load(plan, good, run, remaining);
  if (!input) return;
  const std::string& title = plan.inputs[plan.items[good.front()].input].choice.title();
  InputWork work{{.repeat = plan.study.repeat}, {}};
  for (std::span<const std::size_t> items = good; !items.empty();) {
    Waiting waiting = map_some(plan, items, *input, work, run, remaining, later);
    tell_stage(run, "measuring " + title);
    measure_all(plan, waiting, run.threads, remaining);
  }
}

/// Input by input.
void compute_all(const BatchPlan& plan, std::span<const std::size_t> items, const BatchRun& run,
                 Remaining& remaining, std::vector<std::size_t>& later) {
  for (std::size_t begin = 0; begin < items.size();) {
    std::size_t end = begin + 1;
    while (end < items.size() && plan.items[items[end]].input == plan.items[items[begin]].input) ++end;
    compute(plan, items.subspan(begin, end - begin), run, remaining, later);
    begin = end;
  }
}

/// Waits for those that other runs are at. Returns those without a result then. Nothing else is locked
/// meanwhile, so that no two runs wait for each other.
std::vector<std::size_t> still_missing(const BatchPlan& plan, std::span<const std::size_t> items,
                                       const BatchRun& run, Remaining& remaining) {
  std::vector<std::size_t> missing;
  for (const std::size_t index : items) {
    const BatchItem& item = plan.items[index];
    remaining.locks.lock(item.key);
    if (is_done(plan, run, item, read_item(run.folder, plan, item).state))
      remaining.leave(item);
    else
      missing.push_back(index);
    remaining.locks.unlock(item.key);
  }
  return missing;
}

}  // namespace

BatchTally run_batch(const BatchPlan& plan, const BatchRun& run) {
  remove_stale_partials(run.folder);
  remove_stale_partials(run.folder / kItemsFolder);
  BatchTally tally;
  const std::vector<std::size_t> missing = items_to_compute(plan, run, tally);
  Remaining remaining(plan, run, missing.size());
  std::vector<std::size_t> later;
  compute_all(plan, missing, run, remaining, later);
  while (!later.empty()) {
    tell_stage(run, "waiting for another run in the folder");
    const std::vector<std::size_t> rest = still_missing(plan, later, run, remaining);
    later.clear();
    compute_all(plan, rest, run, remaining, later);
  }
  tally.computed = remaining.computed();
  tally.there = tally.items - tally.shared - tally.computed;
  tally.failed = remaining.failed();
  return tally;
}

std::vector<StoredItem> read_items(const BatchPlan& plan, const fs::path& folder) {
  std::vector<StoredItem> stored;
  stored.reserve(plan.items.size());
  for (const BatchItem& item : plan.items) stored.push_back(read_item(folder, plan, item));
  return stored;
}

}  // namespace plenolab
