#include "experiments/batch/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/statistics.h"
#include "experiments/batch/picture.h"

namespace plenolab {

namespace {

bool has(const ItemResult& result, const std::string& quantity) {
  return quantity.empty() || result.find(quantity);
}

/// Names and units of all quantities, in order of first appearance.
std::vector<Measurement> quantities_in(const std::vector<StoredItem>& stored) {
  std::vector<Measurement> found;
  std::set<std::string> names;
  const auto add = [&](const std::vector<Measurement>& measurements) {
    for (const Measurement& m : measurements)
      if (names.insert(m.quantity).second) found.push_back(m);
  };
  for (const StoredItem& item : stored) {
    add(item.result.values);
    for (const MetricResult& metric : item.result.metrics) add(metric.values);
  }
  return found;
}

std::size_t views_in(const BatchPlan& plan) {
  return plan.items.size() / plan.operators.size();
}

/// Of the channel values of an image.
std::vector<double> shares_of_values(const std::vector<const ItemResult*>& results,
                                     const std::string& quantity) {
  constexpr double kChannels = 3;
  std::vector<double> shares;
  for (const ItemResult* result : results)
    if (const Measurement* const m = result->find(quantity))
      shares.push_back(m->value / (kChannels * result->width * result->height));
  return shares;
}

/// Inputs whose unit is not known, with the metrics that are left out there.
std::string left_out_text(const BatchPlan& plan) {
  constexpr int kMostNamed = 5;
  std::string metrics, inputs;
  for (const Metric* metric : plan.unscalable) metrics += (metrics.empty() ? "" : " and ") + metric->name;
  int unknown = 0;
  for (const BatchInput& input : plan.inputs)
    if (!input.cd_m2_per_unit && input.problem.empty() && ++unknown <= kMostNamed)
      inputs += (inputs.empty() ? "" : ", ") + title_of(input);
  if (unknown > kMostNamed) inputs += fmt::format(" and {} more", unknown - kMostNamed);
  if (metrics.empty() || inputs.empty()) return "";
  return fmt::format(
      "Left out: {} for {}, whose unit is not known; \"cd_m2_per_unit\" in the study would say it.", metrics,
      inputs);
}

/// Quantities over so many views.
std::string shared_text(std::size_t views, std::size_t all, const std::string& names) {
  if (views == 0)
    return fmt::format("No view has a value from all operators, so there is no mean: {}.", names);
  return fmt::format("Over {} of {} views, those that all operators have: {}.", views, all, names);
}

}  // namespace

ComparedItems compared_items(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                             const std::string& quantity, std::optional<std::size_t> input) {
  const std::size_t operators = plan.operators.size();
  const auto counts = [&](std::size_t i) {
    return stored[i].mapped() && (!input || plan.items[i].input == *input) && has(stored[i].result, quantity);
  };
  std::set<std::size_t> part;
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (counts(i)) part.insert(plan.items[i].op);
  ComparedItems compared{std::vector<std::vector<const ItemResult*>>(operators), 0, {}};
  if (part.empty()) return compared;
  // Items are view by view, in the order of the operators.
  for (std::size_t view = 0; view < views_in(plan); ++view) {
    const std::size_t first = view * operators;
    if (!std::all_of(part.begin(), part.end(), [&](std::size_t op) { return counts(first + op); })) continue;
    for (const std::size_t op : part) compared.results[op].push_back(&stored[first + op].result);
    ++compared.views;
    compared.inputs.push_back(plan.items[first].input);
  }
  return compared;
}

std::vector<double> means_of_inputs(const ComparedItems& compared, const std::vector<double>& values) {
  std::vector<double> means, views;
  for (std::size_t i = 0; i < values.size(); ++i) {
    views.push_back(values[i]);
    if (i + 1 < values.size() && compared.inputs[i + 1] == compared.inputs[i]) continue;
    means.push_back(mean(views));
    views.clear();
  }
  return means;
}

std::vector<double> values_of(const std::vector<const ItemResult*>& results, const std::string& quantity) {
  std::vector<double> values;
  for (const ItemResult* result : results)
    if (const Measurement* const m = result->find(quantity)) values.push_back(m->value);
  return values;
}

std::vector<double> milliseconds_per_megapixel(const std::vector<const ItemResult*>& results) {
  std::vector<double> values;
  for (const ItemResult* result : results) {
    const std::vector<Measurement>& timings = result->timings;
    const double seconds = value_of(timings, "seconds_statistics") +
                           value_of(timings, "seconds_fit") / value_of(timings, "fit_views") +
                           value_of(timings, "seconds_map");
    values.push_back(seconds * 1e9 / (static_cast<double>(result->width) * result->height));
  }
  return values;
}

ResultTable operator_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  const std::size_t operators = plan.operators.size();
  const auto columns = [&](std::size_t op) { return Columns{{"operator", plan.operators[op].title()}}; };
  std::vector<std::size_t> done(operators, 0);
  for (std::size_t i = 0; i < stored.size(); ++i)
    done[plan.items[i].op] += stored[i].state == ItemState::kDone ? 1 : 0;
  ResultTable table;
  for (std::size_t op = 0; op < operators; ++op)
    table.add({"items", static_cast<double>(done[op]), "1", columns(op)});
  for (const Measurement& m : quantities_in(stored)) {
    const ComparedItems compared = compared_items(plan, stored, m.quantity);
    for (std::size_t op = 0; op < operators; ++op)
      if (!compared.results[op].empty())
        table.add({m.quantity, mean(means_of_inputs(compared, values_of(compared.results[op], m.quantity))),
                   m.unit, columns(op)});
  }
  for (const char* quantity : {"clipped_high", "clipped_low"}) {
    const ComparedItems compared = compared_items(plan, stored, quantity);
    for (std::size_t op = 0; op < operators; ++op)
      if (!compared.results[op].empty())
        table.add({std::string(quantity) + "_share",
                   mean(means_of_inputs(compared, shares_of_values(compared.results[op], quantity))), "1",
                   columns(op)});
  }
  const ComparedItems timed = compared_items(plan, stored, "");
  for (std::size_t op = 0; op < operators; ++op)
    if (!timed.results[op].empty())
      table.add({"ms_per_megapixel",
                 median(means_of_inputs(timed, milliseconds_per_megapixel(timed.results[op]))), "ms",
                 columns(op)});
  return table;
}

std::vector<std::string> comparison_notes(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  std::vector<std::pair<std::size_t, std::string>> partial;  // views, names of quantities over so many
  const auto add = [&](const std::string& quantity, const std::string& name) {
    const std::size_t views = compared_items(plan, stored, quantity).views;
    if (views == views_in(plan)) return;
    const auto same =
        std::find_if(partial.begin(), partial.end(), [&](const auto& entry) { return entry.first == views; });
    if (same == partial.end())
      partial.emplace_back(views, name);
    else
      same->second += ", " + name;
  };
  for (const Metric* metric : plan.metrics)
    add(metric->quantities.front().name, metric->quantities.front().name);
  add("", "ms/megapixel");
  std::vector<std::string> notes;
  for (const auto& entry : partial) notes.push_back(shared_text(entry.first, views_in(plan), entry.second));
  if (const std::string left_out = left_out_text(plan); !left_out.empty()) notes.push_back(left_out);
  return notes;
}

std::vector<std::string> exposure_notes(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> notes;
  for (const char* remark : {"nearly white", "nearly black"}) {
    std::size_t count = 0;
    std::string names;
    for (std::size_t i = 0; i < stored.size(); ++i) {
      if (!stored[i].mapped() || std::string(exposure_remark(stored[i].result)) != remark) continue;
      if (++count <= kMostNamed) names += (names.empty() ? "" : "; ") + plan.title(plan.items[i]);
    }
    if (count == 0) continue;
    if (count > kMostNamed) names += fmt::format("; and {} more", count - kMostNamed);
    const bool white = std::string(remark) == "nearly white";
    notes.push_back(fmt::format("Mapped images that are {} (mean luma {} {}): {} of {}: {}.", remark,
                                white ? "above" : "below", white ? kNearlyWhite_luma : kNearlyBlack_luma,
                                count, stored.size(), names));
  }
  return notes;
}

std::string title_of(const BatchInput& input) {
  return input.choice.title() + (input.choice.preset.empty() ? "" : " " + input.choice.preset);
}

}  // namespace plenolab
