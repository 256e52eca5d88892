#include "experiments/batch/item_result.h"

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
constexpr int kVersion = 1;

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

ItemResult result_of(const Json& json) {
  return {.failure = json.at("failure"),
          .values = measurements_of(json.at("values")),
          .timings = measurements_of(json.at("timings")),
          .width = json.at("width"),
          .height = json.at("height"),
          .seconds = json.at("seconds")};
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

fs::path item_file(const fs::path& folder, const BatchItem& item) {
  return folder / kItemsFolder / (item.key + ".json");
}

StoredItem read_item(const fs::path& folder, const BatchItem& item) {
  const fs::path file = item_file(folder, item);
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  try {
    Json json = Json::parse(read_text_file(file));
    const std::string claimed = json.at("checksum");
    json.erase("checksum");
    if (checksum(json) != claimed || json.at("format") != kFormat || json.at("version") != kVersion ||
        json.at("key") != item.key)
      return {ItemState::kDamaged, {}};
    ItemResult result = result_of(json);
    return {result.failed() ? ItemState::kFailed : ItemState::kDone, std::move(result)};
  } catch (const Json::exception&) {
    return {ItemState::kDamaged, {}};
  } catch (const InputError&) {
    return {ItemState::kDamaged, {}};
  }
}

std::vector<ItemLabel> other_items(const fs::path& folder, const BatchPlan& plan) {
  std::set<std::string> known;
  for (const BatchItem& item : plan.items) known.insert(item_file(folder, item).filename().string());
  std::vector<ItemLabel> labels;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / kItemsFolder, error)) {
    const std::string name = entry.path().filename().string();
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
