#include "analysis/calibration/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace plenolab {

namespace {
constexpr std::size_t kMostElements = 100000;
constexpr std::size_t kMostText = 4000;
}  // namespace

JsonNode::JsonNode(const nlohmann::json& json, std::string file, std::string place)
    : json_(&json), file_(std::move(file)), place_(std::move(place)) {}

void JsonNode::wrong(const std::string& what) const {
  throw InputError(place_.empty() ? fmt::format("{}: the file {}", file_, what)
                                  : fmt::format("{}: \"{}\" {}", file_, place_, what));
}

void JsonNode::require_object() const {
  if (!json_->is_object()) wrong(fmt::format("must be an object, not {}", json_->type_name()));
}

bool JsonNode::has(const std::string& key) const {
  return json_->contains(key);
}

JsonNode JsonNode::at(const std::string& key) const {
  require_object();
  const auto found = json_->find(key);
  const std::string place = place_.empty() ? key : place_ + "." + key;
  if (found == json_->end()) throw InputError(fmt::format("{}: \"{}\" is missing", file_, place));
  return {*found, file_, place};
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!json_->is_array()) wrong(fmt::format("must be a list, not {}", json_->type_name()));
  if (json_->size() > kMostElements) wrong(fmt::format("must have at most {} elements", kMostElements));
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < json_->size(); ++i)
    nodes.emplace_back((*json_)[i], file_, fmt::format("{}[{}]", place_, i));
  return nodes;
}

std::vector<std::string> JsonNode::keys() const {
  require_object();
  std::vector<std::string> names;
  for (const auto& item : json_->items()) names.push_back(item.key());
  return names;
}

std::string JsonNode::text() const {
  if (!json_->is_string()) wrong(fmt::format("must be a text, not {}", json_->type_name()));
  std::string value = json_->get<std::string>();
  if (value.size() > kMostText) wrong(fmt::format("must be a text of at most {} bytes", kMostText));
  return value;
}

double JsonNode::number() const {
  if (!json_->is_number()) wrong(fmt::format("must be a number, not {}", json_->type_name()));
  const double value = json_->get<double>();
  if (!std::isfinite(value)) wrong("must be a finite number");
  return value;
}

int JsonNode::integer() const {
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > 1e6)
    wrong(fmt::format("must be a whole number up to a million, not {}", value));
  return static_cast<int>(value);
}

bool JsonNode::truth() const {
  if (!json_->is_boolean()) wrong(fmt::format("must be true or false, not {}", json_->type_name()));
  return json_->get<bool>();
}

std::size_t JsonNode::one_of(const std::vector<std::string>& words) const {
  const std::string value = text();
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == value) return i;
    list += (i == 0 ? "\"" : i + 1 == words.size() ? " or \"" : ", \"") + words[i] + "\"";
  }
  wrong(fmt::format("must be {}, not \"{}\"", list, value.substr(0, 80)));
}

void JsonNode::allow_only(const std::vector<std::string>& known) const {
  for (const std::string& key : keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      at(key).wrong("is not a key of this format: check its spelling");
}

}  // namespace plenolab
