#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/batch/plan.h"
#include "metrics/comparison.h"

namespace plenolab {

/// What a metric made of a mapped image.
struct MetricResult {
  std::string name;                 ///< Metric::name
  std::string key;                  ///< BatchPlan::metric_key
  std::string failure;              ///< why there are no values; empty if there are
  std::vector<Measurement> values;  ///< the same at every run
  double seconds = 0;               ///< that it took
};

/// What came of one item.
struct ItemResult {
  std::string failure;                ///< why it is not mapped; empty if it is
  std::vector<Measurement> values;    ///< of the mapping, the same at every run: mean_luma, counts
  std::vector<MetricResult> metrics;  ///< in the order of the plan
  std::vector<Measurement> timings;   ///< of statistics, fit and mapping
  int width = 0, height = 0;          ///< pixels
  double seconds = 0;                 ///< that the mapping took

  /// Whether there is no mapped image, and so nothing at all.
  bool failed() const { return !failure.empty(); }
  /// Why it, or each metric that failed, has no numbers; empty if all have.
  std::string failures() const;
  /// A value of the mapping or of a metric; null if there is none.
  const Measurement* find(const std::string& quantity) const;
  /// Of a metric with this key; null if there is none.
  const MetricResult* metric(const std::string& key) const;
  double seconds_with_metrics() const;
};

/// What stands on disk for an item.
enum class ItemState {
  kMissing,
  kDamaged,     ///< there is a file, but not one that was written whole, for this item
  kIncomplete,  ///< mapped, but without some metric of the study
  kFailed,      ///< all is there, but the mapping or some metrics failed, and these are tried again
  kDone,
};

struct StoredItem {
  ItemState state = ItemState::kMissing;
  ItemResult result;  ///< if incomplete, failed or done

  /// Whether there is a mapping with its values.
  bool mapped() const { return state >= ItemState::kIncomplete && !result.failed(); }
};

/// Folder of the results of items, below that of a batch.
inline constexpr const char* kItemsFolder = "items";

/// Name of an item's file below the folder of a batch: items/KEY.json.
std::filesystem::path item_file(const std::filesystem::path& folder, const BatchItem& item);

/// Reads the file of an item, with the metrics of the plan; one whose checksum or key does not fit it is
/// damaged.
StoredItem read_item(const std::filesystem::path& folder, const BatchPlan& plan, const BatchItem& item);

/// Adds metrics that `more` has of the same item and `item` has not, or has failed at; takes all of it where
/// `item` is not mapped.
void complete(const BatchPlan& plan, const BatchItem& item, StoredItem& stored, const StoredItem& more);

/// What a result says of itself, whichever plan it is of.
struct ItemLabel {
  std::string title;              ///< BatchPlan::title of its item
  bool is_of_this_build = false;  ///< by the same sources of operators and metrics, and the same compiler
};

/// Labels of the results below a folder that are of no item of the plan; what cannot be read is left out.
std::vector<ItemLabel> other_items(const std::filesystem::path& folder, const BatchPlan& plan);

/// Writes it, whole or not at all, with what identifies the item for people. Metrics of other studies that
/// the file holds already stay in it.
void write_item(const std::filesystem::path& folder, const BatchPlan& plan, const BatchItem& item,
                const ItemResult& result);

}  // namespace plenolab
