#include "experiments/batch/item_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include <method_sources.h>
#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "plenolab-batch-item";
constexpr int kVersion = 2;

std::string dumped(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

std::string checksum(const Json& json) {
  ContentHash hash;
  hash.add(dumped(json));
  return hash.hex();
}

/// JSON has no infinity.
Json number_json(double value) {
  if (std::isfinite(value)) return value;
  return value > 0 ? "infinity" : "-infinity";
}

double number_of(const Json& json) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (json.is_string()) return json == "infinity" ? kInfinity : -kInfinity;
  return json.get<double>();
}

Json measurements_json(const std::vector<Measurement>& measurements) {
  Json json = Json::array();
  for (const Measurement& m : measurements)
    json.push_back({{"quantity", m.quantity}, {"value", number_json(m.value)}, {"unit", m.unit}});
  return json;
}

std::vector<Measurement> measurements_of(const Json& json) {
  std::vector<Measurement> measurements;
  for (const Json& entry : json)
    measurements.push_back({entry.at("quantity"), number_of(entry.at("value")), entry.at("unit")});
  return measurements;
}

Json metric_json(const MetricResult& metric) {
  return {{"metric", metric.name},
          {"key", metric.key},
          {"failure", metric.failure},
          {"values", measurements_json(metric.values)},
          {"seconds", metric.seconds}};
}

std::vector<MetricResult> metrics_of(const Json& json) {
  std::vector<MetricResult> metrics;
  for (const Json& entry : json)
    metrics.push_back({entry.at("metric"), entry.at("key"), entry.at("failure"),
                       measurements_of(entry.at("values")), entry.at("seconds")});
  return metrics;
}

ItemResult result_of(const Json& json) {
  return {.failure = json.at("failure"),
          .values = measurements_of(json.at("values")),
          .metrics = metrics_of(json.at("metrics")),
          .timings = measurements_of(json.at("timings")),
          .width = json.at("width"),
          .height = json.at("height"),
          .seconds = json.at("seconds")};
}

/// All that a file of an item holds; nothing if it is damaged.
std::optional<ItemResult> read_whole(const fs::path& file, const BatchItem& item) {
  try {
    Json json = Json::parse(read_text_file(file));
    const std::string claimed = json.at("checksum");
    json.erase("checksum");
    if (checksum(json) != claimed || json.at("format") != kFormat || json.at("version") != kVersion ||
        json.at("key") != item.key)
      return std::nullopt;
    return result_of(json);
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// A result with the metrics of the plan alone, in its order.
StoredItem with_metrics_of(const BatchPlan& plan, const BatchItem& item, const ItemResult& whole) {
  StoredItem stored{ItemState::kFailed, whole};
  stored.result.metrics.clear();
  if (whole.failed()) return stored;
  bool all_there = true;
  for (const Metric* metric : plan.metrics_for(plan.inputs[item.input])) {
    const MetricResult* const found = whole.metric(plan.metric_key(*metric));
    if (found) stored.result.metrics.push_back(*found);
    all_there = all_there && found;
  }
  stored.state = !all_there                         ? ItemState::kIncomplete
                 : stored.result.failures().empty() ? ItemState::kDone
                                                    : ItemState::kFailed;
  return stored;
}

std::optional<ItemLabel> read_label(const fs::path& file) {
  try {
    const Json json = Json::parse(read_text_file(file));
    ItemLabel label{"", json.value("build", "") == method_sources::kHash};
    for (const auto& word : json.at("item").items()) add_word(label.title, word.value());
    return label;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::string ItemResult::failures() const {
  if (failed()) return failure;
  std::string text;
  for (const MetricResult& metric : metrics)
    if (!metric.failure.empty()) text += (text.empty() ? "" : "; ") + metric.name + ": " + metric.failure;
  return text;
}

const Measurement* ItemResult::find(const std::string& quantity) const {
  const auto in = [&](const std::vector<Measurement>& all) -> const Measurement* {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Measurement& m) { return m.quantity == quantity; });
    return found == all.end() ? nullptr : &*found;
  };
  if (const Measurement* found = in(values)) return found;
  for (const MetricResult& metric : metrics)
    if (const Measurement* found = in(metric.values)) return found;
  return nullptr;
}

const MetricResult* ItemResult::metric(const std::string& key) const {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [&](const MetricResult& m) { return m.key == key; });
  return found == metrics.end() ? nullptr : &*found;
}

double ItemResult::seconds_with_metrics() const {
  double sum = seconds;
  for (const MetricResult& metric : metrics) sum += metric.seconds;
  return sum;
}

fs::path item_file(const fs::path& folder, const BatchItem& item) {
  return folder / kItemsFolder / (item.key + ".json");
}

StoredItem read_item(const fs::path& folder, const BatchPlan& plan, const BatchItem& item) {
  const fs::path file = item_file(folder, item);
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  const std::optional<ItemResult> whole = read_whole(file, item);
  if (!whole) return {ItemState::kDamaged, {}};
  return with_metrics_of(plan, item, *whole);
}

void complete(const BatchPlan& plan, const BatchItem& item, StoredItem& stored, const StoredItem& more) {
  if (!stored.mapped()) {
    if (more.state > stored.state || more.mapped()) stored = more;
    return;
  }
  if (!more.mapped()) return;
  ItemResult both = stored.result;
  std::erase_if(both.metrics, [](const MetricResult& metric) { return !metric.failure.empty(); });
  for (const ItemResult* result : std::array<const ItemResult*, 2>{&more.result, &stored.result})
    for (const MetricResult& metric : result->metrics)
      if (!both.metric(metric.key)) both.metrics.push_back(metric);
  stored = with_metrics_of(plan, item, both);
}

std::vector<ItemLabel> other_items(const fs::path& folder, const BatchPlan& plan) {
  std::set<std::string> known;
  for (const BatchItem& item : plan.items) known.insert(item_file(folder, item).filename().string());
  std::vector<ItemLabel> labels;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / kItemsFolder, error)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".json") continue;
    if (name.starts_with('.') || known.count(name) > 0) continue;
    if (std::optional<ItemLabel> label = read_label(entry.path())) labels.push_back(std::move(*label));
  }
  return labels;
}

void write_item(const fs::path& folder, const BatchPlan& plan, const BatchItem& item,
                const ItemResult& result) {
  Json json{{"format", kFormat}, {"version", kVersion}, {"key", item.key}, {"build", method_sources::kHash}};
  for (const auto& [name, cell] : plan.columns(item)) json["item"][name] = std::get<std::string>(cell);
  json["failure"] = result.failure;
  json["values"] = measurements_json(result.values);
  json["metrics"] = Json::array();
  for (const MetricResult& metric : result.metrics) json["metrics"].push_back(metric_json(metric));
  if (const std::optional<ItemResult> before = read_whole(item_file(folder, item), item))
    for (const MetricResult& metric : before->metrics)
      if (!result.metric(metric.key)) json["metrics"].push_back(metric_json(metric));
  json["timings"] = measurements_json(result.timings);
  json["width"] = result.width;
  json["height"] = result.height;
  json["seconds"] = result.seconds;
  // Read back once: what cannot be kept as it is (names that are not UTF-8) must not spoil the checksum.
  json = Json::parse(dumped(json));
  json["checksum"] = checksum(json);
  write_text_file(item_file(folder, item), dumped(json) + "\n");
}

}  // namespace plenolab
