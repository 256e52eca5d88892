#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace plenolab {

/// A JSON value with the name of its file and its place in it, so that every complaint can say where. Every
/// reader throws InputError in one sentence, e.g. m.json: "records[0].sd_mm" must be a number, not string.
class JsonNode {
 public:
  /// `json` must outlive the node.
  JsonNode(const nlohmann::json& json, std::string file, std::string place);

  [[noreturn]] void wrong(const std::string& what) const;
  void require_object() const;
  bool has(const std::string& key) const;
  JsonNode at(const std::string& key) const;  ///< of an object; an error if it is missing
  std::vector<std::string> keys() const;
  std::vector<JsonNode> elements() const;  ///< of a list of at most 100000

  std::string text() const;  ///< of at most 4000 bytes
  double number() const;     ///< finite
  int integer() const;       ///< up to a million
  bool truth() const;
  /// Which of the words it is.
  std::size_t one_of(const std::vector<std::string>& words) const;
  /// Throws for a key that is none of these.
  void allow_only(const std::vector<std::string>& known) const;

 private:
  const nlohmann::json* json_;
  std::string file_, place_;
};

}  // namespace plenolab
