#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "experiments/batch/adjusted.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// An operator fitted to a view or to a whole light field, and how long that took at each of `repeat` times.
/// With key-view adjustment all views are mapped, once: that is the fit.
struct TimedFit {
  FittedOperator fitted;
  std::optional<AdjustedField> adjusted;  ///< with key-view adjustment, in place of `fitted`
  std::vector<double> seconds;
  int views = 1;  ///< that it is for
};

/// What is made once for several items of an input.
struct SharedWork {
  int repeat = 1;                                               ///< timed runs
  std::map<std::size_t, std::shared_ptr<const TimedFit>> fits;  ///< for whole light fields, by operator
  std::map<BatchView, double> statistics_s;                     ///< median time of a view's statistics
};

/// Whether an operator reads statistics of luminance (FitScope: statistics, floor or log average) at all.
/// Those are measured once for all operators, so that their time must be counted to each that reads them.
bool reads_statistics(const OperatorChoice& choice, bool unit_is_known);

/// An item that is mapped and not yet measured.
struct MappedItem {
  OperatorView view;
  DisplayImage image;
  ItemResult result;  ///< with counts and timings, or with a failure
};

/// Fits and maps, each `shared.repeat` times on `threads` threads, after one time that does not count if
/// there are several; what is in `shared` is not made again. Values: mean_luma, counts of add_count_rows,
/// with key-view adjustment those of add_adjustment_rows, left_out_pixels (those where the input is NaN or
/// infinite). Timings: those of add_timing_rows, of fit and mapping together, the medians seconds_fit and
/// seconds_map, fit_views, for how many views the fit is, and seconds_statistics, the median for the
/// statistics of this view (those of others count to theirs), 0 if the operator reads none. Whatever goes
/// wrong is the result's failure.
MappedItem map_item(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input,
                    SharedWork& shared, int threads);

/// Adds the metrics of the plan that the result has not, or has failed at, over all pixels but those left
/// out. Whatever goes wrong is that metric's failure.
void measure_item(const BatchPlan& plan, const BatchItem& item, MappedItem& mapped, int threads);

/// The result of an item that failed.
ItemResult failed_result(const std::string& failure);

}  // namespace plenolab
