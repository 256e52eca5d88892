#pragma once

#include <vector>

#include "experiments/batch/item_result.h"

namespace plenolab {

/// Results of all items of an operator that are done, in the order of the plan.
std::vector<const ItemResult*> results_of(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                                          std::size_t op);

/// Values of a quantity, of the results that have it.
std::vector<double> values_of(const std::vector<const ItemResult*>& results, const std::string& quantity);

/// Median time of fit and mapping of each result, for a million pixels; a fit for several views counts for
/// each of them in part.
std::vector<double> milliseconds_per_megapixel(const std::vector<const ItemResult*>& results);

/// For each operator (column `operator`) the mean of every quantity over its items, `items` (those that are
/// done) and ms_per_megapixel, the median over items: for people.
ResultTable operator_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored);

}  // namespace plenolab
