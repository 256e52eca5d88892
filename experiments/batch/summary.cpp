#include "experiments/batch/summary.h"

#include <algorithm>

#include "analysis/statistics.h"

namespace plenolab {

namespace {

/// Names and units of all quantities, in order of first appearance.
std::vector<Measurement> quantities_in(const std::vector<const ItemResult*>& results) {
  std::vector<Measurement> found;
  for (const ItemResult* result : results)
    for (const Measurement& m : result->values)
      if (std::none_of(found.begin(), found.end(),
                       [&](const Measurement& known) { return known.quantity == m.quantity; }))
        found.push_back(m);
  return found;
}

}  // namespace

std::vector<const ItemResult*> results_of(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                                          std::size_t op) {
  std::vector<const ItemResult*> results;
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (plan.items[i].op == op && stored[i].state == ItemState::kDone) results.push_back(&stored[i].result);
  return results;
}

std::vector<double> values_of(const std::vector<const ItemResult*>& results, const std::string& quantity) {
  std::vector<double> values;
  for (const ItemResult* result : results)
    for (const Measurement& m : result->values)
      if (m.quantity == quantity) values.push_back(m.value);
  return values;
}

std::vector<double> milliseconds_per_megapixel(const std::vector<const ItemResult*>& results) {
  std::vector<double> values;
  for (const ItemResult* result : results) {
    const std::vector<Measurement>& timings = result->timings;
    const double seconds =
        value_of(timings, "seconds_fit") / value_of(timings, "fit_views") + value_of(timings, "seconds_map");
    values.push_back(seconds * 1e9 / (static_cast<double>(result->width) * result->height));
  }
  return values;
}

ResultTable operator_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t op = 0; op < plan.operators.size(); ++op) {
    const Columns columns{{"operator", plan.operators[op].title()}};
    const std::vector<const ItemResult*> results = results_of(plan, stored, op);
    table.add({"items", static_cast<double>(results.size()), "1", columns});
    if (results.empty()) continue;
    for (const Measurement& m : quantities_in(results))
      table.add({m.quantity, mean(values_of(results, m.quantity)), m.unit, columns});
    table.add({"ms_per_megapixel", median(milliseconds_per_megapixel(results)), "ms", columns});
  }
  return table;
}

}  // namespace plenolab
