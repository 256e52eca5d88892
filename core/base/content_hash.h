#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace plenolab {

/// 128-bit content hash (XXH3, not cryptographic): names cached renders and identifies inputs in run.json.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  void add_bytes(const void* data, std::size_t size);
  /// Adds a length-prefixed string, so that ("ab", "c") and ("a", "bc") differ.
  void add(std::string_view text);
  void add(double value);
  /// 32 lower-case hexadecimal digits.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Hash of a file's bytes. Throws InputError if it cannot be read.
std::string hash_file(const std::filesystem::path& path);

}  // namespace plenolab
