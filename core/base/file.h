#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace plenolab {

/// Runs `write` on a temporary name in the folder of `path`, then renames it to `path`, so that the file
/// appears whole or not at all; missing folders are created and the temporary file is removed on any
/// exception. The temporary name keeps the extension of `path`. A symbolic link is followed; a device or pipe
/// is written into directly. Throws InputError if the folder or file cannot be written.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes text (or bytes) atomically.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Reads a whole file of at most `max_bytes`. Throws InputError if it is missing, not a regular file, or
/// larger.
std::string read_text_file(const std::filesystem::path& path, std::uintmax_t max_bytes = 64u << 20);

/// A fresh folder below the system's temporary folder that disappears with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace plenolab
