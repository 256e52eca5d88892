#pragma once

#include <map>
#include <memory>
#include <vector>

#include "experiments/batch/adjusted.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// An operator fitted to a view or to a whole light field, and how long that took at each of `repeat` times.
/// With key-view adjustment all views are mapped, once: that is the fit.
struct TimedFit {
  FittedOperator fitted;
  AdjustedViews adjusted;  ///< with key-view adjustment, in place of `fitted`
  std::vector<double> seconds;
  int views = 1;  ///< that it is for
};

/// Fits for whole light fields, by operator of the plan: made once for all views of an input.
using SharedFits = std::map<std::size_t, std::shared_ptr<const TimedFit>>;

/// An item that is mapped and not yet measured.
struct MappedItem {
  OperatorView view;
  DisplayImage image;
  ItemResult result;  ///< with counts and timings, or with a failure
};

/// Fits and maps, each `repeat` times on `threads` threads, after one time that does not count if there are
/// several; a fit that is in `fits` is not made again. Values: mean_luma, counts of add_count_rows. Timings:
/// those of add_timing_rows, of fit and mapping together, the medians seconds_fit and seconds_map, and
/// fit_views, for how many views the fit is. Whatever goes wrong is the result's failure.
MappedItem map_item(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input, SharedFits& fits,
                    int threads);

/// Adds the values of the metrics, over all pixels but those where the input is NaN or infinite, whose number
/// is the value left_out_pixels. Whatever goes wrong is the result's failure.
void measure_item(const BatchPlan& plan, const BatchItem& item, MappedItem& mapped, int threads);

/// The result of an item that failed.
ItemResult failed_result(const std::string& failure);

}  // namespace plenolab
