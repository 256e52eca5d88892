#pragma once

#include <vector>

#include "experiments/batch/item_result.h"

namespace plenolab {

/// An item that is mapped and not yet measured.
struct MappedItem {
  OperatorView view;
  DisplayImage image;
  ItemResult result;  ///< with counts and timings, or with a failure
};

/// Fits and maps, `repeat` times on `threads` threads, after one time that does not count if there are
/// several. Values: mean_luma, counts of add_count_rows. Timings: those of add_timing_rows, of fit and
/// mapping together, and the medians seconds_fit and seconds_map. Whatever goes wrong is the result's
/// failure.
MappedItem map_item(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input, int threads);

/// Adds the values of the metrics. Whatever goes wrong is the result's failure.
void measure_item(const BatchPlan& plan, const BatchItem& item, MappedItem& mapped, int threads);

/// The result of an item that failed.
ItemResult failed_result(const std::string& failure);

}  // namespace plenolab
