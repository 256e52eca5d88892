#include "core/io/bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "core/base/error.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
}

std::uint64_t size_of_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{} does not exist", path.string()));
  if (!fs::is_regular_file(status)) throw InputError(fmt::format("{} is not a file", path.string()));
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(fmt::format("cannot read {}: {}", path.string(), error.message()));
  return size;
}

std::vector<std::byte> read_beginning(const fs::path& path, std::uint64_t count) {
  std::vector<std::byte> bytes(std::min(count, size_of_file(path)));
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file || std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    throw InputError(fmt::format("cannot read {}", path.string()));
  return bytes;
}

std::vector<std::byte> read_bytes(const fs::path& path, std::uint64_t max_bytes) {
  const std::uint64_t size = size_of_file(path);
  if (size > max_bytes)
    throw InputError(
        fmt::format("{} has {} bytes, more than the {} allowed here", path.string(), size, max_bytes));
  return read_beginning(path, size);
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  return extension;
}

}  // namespace plenolab
