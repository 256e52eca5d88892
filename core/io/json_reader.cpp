#include "core/io/json_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "core/base/error.h"

namespace plenolab {

using Json = nlohmann::json;

Json parse_json(std::string_view text, const std::string& name, int max_nesting) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto checked = [&](int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > max_nesting) throw InputError(fmt::format("{} is nested too deeply", name));
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    // The parser would silently take the last of them.
    if (event == Event::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw InputError(fmt::format("{} has the key \"{}\" twice in one object", name,
                                   parsed.get<std::string>().substr(0, 80)));
    return true;
  };
  try {
    return Json::parse(text, checked);
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{} is not valid JSON: {}", name, error.what()));
  }
}

JsonReader::JsonReader(const Json& json, std::string file, std::string place)
    : json_(json), file_(std::move(file)), place_(std::move(place)) {
  if (!json_.is_object())
    throw InputError(place_.empty() ? fmt::format("{}: the file must hold one object", file_)
                                    : fmt::format("{}: \"{}\" must be an object, not {}", file_, place_,
                                                  json_.type_name()));
}

void JsonReader::wrong(const std::string& key, const std::string& what) const {
  throw InputError(fmt::format("{}: \"{}\" {}", file_, place_of(key), what));
}

const Json& JsonReader::value(const std::string& key) const {
  const auto found = json_.find(key);
  if (found == json_.end()) wrong(key, "is missing");
  return *found;
}

JsonReader JsonReader::object(const std::string& key) const {
  return JsonReader(value(key), file_, place_of(key));
}

std::vector<JsonReader> JsonReader::objects(const std::string& key, std::size_t most) const {
  const Json& array = value(key);
  if (!array.is_array()) wrong(key, fmt::format("must be an array, not {}", array.type_name()));
  if (array.size() > most)
    wrong(key, fmt::format("must have at most {} entries, not {}", most, array.size()));
  std::vector<JsonReader> result;
  for (const Json& entry : array)
    result.emplace_back(entry, file_, fmt::format("{}[{}]", place_of(key), result.size()));
  return result;
}

std::vector<std::string> JsonReader::texts(const std::string& key, std::size_t most,
                                           std::size_t longest) const {
  const Json& array = value(key);
  if (!array.is_array()) wrong(key, fmt::format("must be an array, not {}", array.type_name()));
  if (array.size() > most)
    wrong(key, fmt::format("must have at most {} entries, not {}", most, array.size()));
  std::vector<std::string> result;
  for (const Json& entry : array)
    result.push_back(checked_text(entry, fmt::format("{}[{}]", key, result.size()), longest));
  return result;
}

std::string JsonReader::text(const std::string& key, std::size_t longest) const {
  return checked_text(value(key), key, longest);
}

std::string JsonReader::checked_text(const Json& json, const std::string& key, std::size_t longest) const {
  if (!json.is_string()) wrong(key, fmt::format("must be a text, not {}", json.type_name()));
  const std::string result = json.get<std::string>();
  if (result.empty() || result.size() > longest || result.find('\0') != std::string::npos)
    wrong(key, fmt::format("must be a text of 1 to {} characters", longest));
  return result;
}

int JsonReader::integer(const std::string& key, int smallest, int largest) const {
  const Json& json = value(key);
  if (!json.is_number_integer())
    wrong(key, fmt::format("must be a whole number, not {}", json.dump(-1, ' ', true).substr(0, 40)));
  const double number = json.get<double>();
  if (!(number >= smallest && number <= largest))
    wrong(key, fmt::format("must lie in [{}, {}], not {}", smallest, largest, number));
  return json.get<int>();
}

double JsonReader::positive(const std::string& key) const {
  const Json& json = value(key);
  if (!json.is_number()) wrong(key, fmt::format("must be a number, not {}", json.type_name()));
  const double number = json.get<double>();
  if (!(number > 0) || !std::isfinite(number)) wrong(key, fmt::format("must be positive, not {}", number));
  return number;
}

bool JsonReader::boolean(const std::string& key) const {
  const Json& json = value(key);
  if (!json.is_boolean()) wrong(key, fmt::format("must be true or false, not {}", json.type_name()));
  return json.get<bool>();
}

void JsonReader::allow_only(std::initializer_list<const char*> keys) const {
  for (const auto& item : json_.items()) {
    bool known = false;
    for (const char* key : keys) known = known || item.key() == key;
    if (!known) wrong(item.key().substr(0, 80), "is not a key of this format: check its spelling");
  }
}

}  // namespace plenolab
