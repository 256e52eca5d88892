#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/batch/plan.h"
#include "metrics/comparison.h"

namespace plenolab {

/// What came of one item.
struct ItemResult {
  std::string failure;               ///< why there are no numbers; empty if there are
  std::vector<Measurement> values;   ///< the same at every run: counts of the mapping, metrics
  std::vector<Measurement> timings;  ///< of fit and mapping
  int width = 0, height = 0;         ///< pixels
  double seconds = 0;                ///< that the item took, metrics included

  bool failed() const { return !failure.empty(); }
};

/// What stands on disk for an item.
enum class ItemState {
  kMissing,
  kDamaged,  ///< there is a file, but not one that was written whole, for this item
  kFailed,   ///< tried without success, and to be tried again
  kDone,
};

struct StoredItem {
  ItemState state = ItemState::kMissing;
  ItemResult result;  ///< if failed or done
};

/// Folder of the results of items, below that of a batch.
inline constexpr const char* kItemsFolder = "items";

/// Name of an item's file below the folder of a batch: items/KEY.json.
std::filesystem::path item_file(const std::filesystem::path& folder, const BatchItem& item);

/// Reads the file of an item; one whose checksum or key does not fit it is damaged.
StoredItem read_item(const std::filesystem::path& folder, const BatchItem& item);

/// What a result says of itself, whichever plan it is of.
struct ItemLabel {
  std::string title;              ///< BatchPlan::title of its item
  bool is_of_this_build = false;  ///< by the same sources of operators and metrics, and the same compiler
};

/// Labels of the results below a folder that are of no item of the plan; what cannot be read is left out.
std::vector<ItemLabel> other_items(const std::filesystem::path& folder, const BatchPlan& plan);

/// Writes it, whole or not at all, with what identifies the item for people.
void write_item(const std::filesystem::path& folder, const BatchPlan& plan, const BatchItem& item,
                const ItemResult& result);

}  // namespace plenolab
