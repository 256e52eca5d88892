#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/batch/item_result.h"

namespace plenolab {

/// Results that operators can be compared by.
struct ComparedItems {
  /// By operator, view by view; empty for operators that do not take part.
  std::vector<std::vector<const ItemResult*>> results;
  std::size_t views = 0;            ///< that all operators which take part have
  std::vector<std::size_t> inputs;  ///< of each of these views
};

/// Results at those views of inputs where every operator that has the quantity at all has it: an operator
/// that failed on the hard ones must not look better for it. An empty quantity stands for the run time, which
/// every item that is done has. With `input` among the views of that one alone.
ComparedItems compared_items(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                             const std::string& quantity, std::optional<std::size_t> input = std::nullopt);

/// Means over the views of each input, in the order of the inputs: one light field of many views must not
/// outweigh photographs. `values` are those of one operator.
std::vector<double> means_of_inputs(const ComparedItems& compared, const std::vector<double>& values);

/// Values of a quantity, of the results that have it.
std::vector<double> values_of(const std::vector<const ItemResult*>& results, const std::string& quantity);

/// Median time of statistics, fit and mapping of each result, for a million pixels; a fit for several views
/// counts for each of them in part.
std::vector<double> milliseconds_per_megapixel(const std::vector<const ItemResult*>& results);

/// For each operator (column `operator`) `items` (those that are done), and over its compared items the mean
/// over inputs (means_of_inputs) of every quantity, the share of channel values cut to 0 and 1
/// (clipped_low_share, clipped_high_share), and ms_per_megapixel, the median over inputs: for people.
ResultTable operator_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored);

/// What must be said beside operator_rows, a sentence each: first quantities of metrics and run times that
/// are over fewer views than the plan has, and metrics that are left out of inputs whose unit is not known.
std::vector<std::string> comparison_notes(const BatchPlan& plan, const std::vector<StoredItem>& stored);

/// Sentences that name items which came out nearly white or nearly black (picture.h).
std::vector<std::string> exposure_notes(const BatchPlan& plan, const std::vector<StoredItem>& stored);

/// Title of an input with its preset.
std::string title_of(const BatchInput& input);

}  // namespace plenolab
