#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/partial_output.h"

namespace plenolab {

/// Runs `write` on a temporary name in the folder of `path`, then renames it to `path`, so that the file
/// appears whole or not at all; missing folders are created and the temporary file is removed on any
/// exception or stop signal (core/base/partial_output.h). The temporary name keeps the extension of `path`. A
/// symbolic link is followed; a device or pipe is written into directly. Throws InputError, which names
/// `path` and the reason, if the folder or file cannot be written.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes bytes to a file that need not be replaced atomically (inside write_atomically). Throws InputError
/// with the reason, e.g. a full disk.
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Writes text (or bytes) atomically.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Reads a whole file of at most `max_bytes`. Throws InputError if it is missing, not a regular file, or
/// larger.
std::string read_text_file(const std::filesystem::path& path, std::uintmax_t max_bytes = 64u << 20);

/// A fresh folder below the system's temporary folder that disappears with the object, or when the process is
/// told to stop.
class TemporaryFolder {
 public:
  TemporaryFolder();
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  PartialOutput folder_;
};

}  // namespace plenolab
