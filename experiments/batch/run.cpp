#include "experiments/batch/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <set>
#include <span>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/stale_partials.h"
#include "experiments/batch/measure.h"

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
      : plan_(plan), run_(run), items_(items) {}

  /// Stores a result and tells how far the run is.
  void finish(const BatchItem& item, ItemResult result) {
    result.failure = plan_.inputs[item.input].as_spelled(result.failure);
    write_item(run_.folder, plan_, item, result);
    const std::lock_guard lock(mutex_);
    ++done_;
    failed_ += result.failed() ? 1 : 0;
    if (run_.progress) run_.progress(static_cast<double>(done_) / static_cast<double>(items_));
  }
  std::size_t failed() const { return failed_; }

 private:
  const BatchPlan& plan_;
  const BatchRun& run_;
  std::mutex mutex_;
  std::size_t items_, done_ = 0, failed_ = 0;
};

void tell_stage(const BatchRun& run, const std::string& stage) {
  if (run.on_stage) run.on_stage(stage);
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
    const ItemState state = read_item(run.folder, item).state;
    if (state == ItemState::kDone) continue;
    if (state == ItemState::kDamaged && run.on_damaged) run.on_damaged(plan.title(item));
    missing.push_back(index);
  }
  return missing;
}

/// Maps items, one after the other, until all are or enough has been done that is not stored.
std::vector<MappedItem> map_some(const BatchPlan& plan, std::span<const std::size_t> items,
                                 const LoadedInput& input, SharedWork& shared, const BatchRun& run) {
  std::vector<MappedItem> mapped;
  std::size_t waiting_px = 0;
  const Stopwatch watch;
  for (const std::size_t index : items) {
    tell_stage(run, "mapping " + plan.title(plan.items[index]));
    mapped.push_back(map_item(plan, plan.items[index], input, shared, run.threads));
    waiting_px += mapped.back().image.size();
    if (waiting_px >= kMostWaiting_px || watch.seconds() > kMostWaiting_s) break;
  }
  return mapped;
}

void measure_all(const BatchPlan& plan, std::span<const std::size_t> items, std::vector<MappedItem>& mapped,
                 int threads, Remaining& remaining) {
  const bool small = std::all_of(mapped.begin(), mapped.end(),
                                 [](const MappedItem& item) { return item.image.size() <= kSmall_px; });
  const bool side_by_side = small && mapped.size() > 1;
  parallel_for(static_cast<int>(mapped.size()), 1, side_by_side ? threads : 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const BatchItem& item = plan.items[items[i]];
      measure_item(plan, item, mapped[i], side_by_side ? 1 : threads);
      remaining.finish(item, mapped[i].result);
      mapped[i] = {};
    }
  });
}

void fail_all(const BatchPlan& plan, std::span<const std::size_t> items, const std::string& failure,
              Remaining& remaining) {
  for (const std::size_t index : items) remaining.finish(plan.items[index], failed_result(failure));
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
      remaining.finish(item, failed_result(item.problem));
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

/// All items are of one input.
void compute(const BatchPlan& plan, std::span<const std::size_t> all, const BatchRun& run,
             Remaining& remaining) {
  const std::vector<std::size_t> good = without_problems(plan, all, remaining);
  if (good.empty()) return;
  const std::unique_ptr<LoadedInput> input = load(plan, good, run, remaining);
  if (!input) return;
  const std::string& title = plan.inputs[plan.items[good.front()].input].choice.title();
  SharedWork shared;
  for (std::span<const std::size_t> items = good; !items.empty();) {
    std::vector<MappedItem> mapped = map_some(plan, items, *input, shared, run);
    tell_stage(run, "measuring " + title);
    measure_all(plan, items, mapped, run.threads, remaining);
    items = items.subspan(mapped.size());
  }
}

}  // namespace

void require_batch_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("{} is not a folder: choose another name", folder.string()));
  if (!fs::is_directory(folder, error) || fs::is_empty(folder, error)) return;
  if (!fs::is_directory(folder / kItemsFolder, error))
    throw InputError(
        fmt::format("{} exists and holds no batch: choose another name or remove it", folder.string()));
}

BatchTally run_batch(const BatchPlan& plan, const BatchRun& run) {
  remove_stale_partials(run.folder);
  remove_stale_partials(run.folder / kItemsFolder);
  BatchTally tally;
  const std::vector<std::size_t> missing = items_to_compute(plan, run, tally);
  Remaining remaining(plan, run, missing.size());
  for (std::size_t begin = 0; begin < missing.size();) {
    std::size_t end = begin + 1;
    while (end < missing.size() && plan.items[missing[end]].input == plan.items[missing[begin]].input) ++end;
    compute(plan, std::span(missing).subspan(begin, end - begin), run, remaining);
    begin = end;
  }
  tally.there = tally.items - tally.shared - missing.size();
  tally.computed = missing.size();
  tally.failed = remaining.failed();
  return tally;
}

std::vector<StoredItem> read_items(const BatchPlan& plan, const fs::path& folder) {
  std::vector<StoredItem> stored;
  stored.reserve(plan.items.size());
  for (const BatchItem& item : plan.items) stored.push_back(read_item(folder, item));
  return stored;
}

}  // namespace plenolab
