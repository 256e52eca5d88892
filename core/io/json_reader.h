#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace plenolab {

/// Parses a JSON document of at most `max_nesting` levels (the parser works recursively: deep nesting would
/// exhaust the stack). No object may have a key twice. Throws InputError naming `name`.
nlohmann::json parse_json(std::string_view text, const std::string& name, int max_nesting);

/// One object of a JSON file from outside, with the name of its file and its place in it, so that every
/// complaint can say where: all functions throw InputError with one sentence that names file and key. The
/// document must outlive the reader.
class JsonReader {
 public:
  JsonReader(const nlohmann::json& json, std::string file, std::string place);

  /// Throws: "FILE: "PLACE.KEY" WHAT".
  [[noreturn]] void wrong(const std::string& key, const std::string& what) const;

  bool has(const std::string& key) const { return json_.contains(key); }
  const nlohmann::json& value(const std::string& key) const;
  JsonReader object(const std::string& key) const;
  /// An array of at most `most` objects.
  std::vector<JsonReader> objects(const std::string& key, std::size_t most) const;
  /// An array of at most `most` texts as in text().
  std::vector<std::string> texts(const std::string& key, std::size_t most, std::size_t longest = 255) const;
  /// 1 to `longest` bytes, without zeros.
  std::string text(const std::string& key, std::size_t longest = 255) const;
  /// A whole number in [smallest, largest].
  int integer(const std::string& key, int smallest, int largest) const;
  /// A finite number > 0.
  double positive(const std::string& key) const;
  bool boolean(const std::string& key) const;
  /// Throws for any other key: it may be a misspelt one.
  void allow_only(std::initializer_list<const char*> keys) const;

 private:
  std::string place_of(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }
  std::string checked_text(const nlohmann::json& json, const std::string& key, std::size_t longest) const;

  const nlohmann::json& json_;
  std::string file_, place_;
};

}  // namespace plenolab
