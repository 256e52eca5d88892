#include "core/base/file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

#include "core/base/error.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

fs::path temporary_name(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  return path.parent_path() / fmt::format(".{}.{}-{}.partial{}", path.stem().string(), ::getpid(), counter++,
                                          path.extension().string());
}

void create_parent(const fs::path& path) {
  if (path.parent_path().empty()) return;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error)
    throw InputError(
        fmt::format("cannot create the folder {}: {}", path.parent_path().string(), error.message()));
}

fs::path make_temporary_folder() {
  std::string name = (fs::temp_directory_path() / "plenolab-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw InputError(fmt::format("cannot create a temporary folder: {}", std::strerror(errno)));
  return name;
}

}  // namespace

void write_atomically(const fs::path& requested, const std::function<void(const fs::path&)>& write) {
  if (requested.empty()) throw InputError("cannot write a file without a name");
  std::error_code unresolved;
  const fs::path target =
      fs::weakly_canonical(requested, unresolved);  // a link stays, the file behind it is replaced
  const fs::path path = unresolved || !fs::is_symlink(requested) ? requested : target;
  if (fs::is_directory(path)) throw InputError(fmt::format("cannot write {}: it is a folder", path.string()));
  if (fs::exists(path) &&
      !fs::is_regular_file(path)) {  // a device or pipe has nothing to protect, and must stay
    write(path);
    return;
  }
  create_parent(path);
  const PartialOutput partial([&] { return temporary_name(path); });
  write_under_temporary_name(partial.path(), path, write);
  partial.put_in_place([&] {
    std::error_code error;
    fs::rename(partial.path(), path, error);
    if (error) throw InputError(fmt::format("cannot write {}: {}", path.string(), error.message()));
  });
}

void write_bytes(const fs::path& path, std::span<const std::byte> bytes) {
  const auto fail_unless = [&](bool ok) {
    if (!ok) throw InputError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), &std::fclose);
  fail_unless(file != nullptr);
  fail_unless(std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size());
  fail_unless(std::fclose(file.release()) == 0);
}

void write_text_file(const fs::path& path, std::string_view text) {
  write_atomically(path, [&](const fs::path& temporary) {
    write_bytes(temporary, std::as_bytes(std::span(text.data(), text.size())));
  });
}

std::string read_text_file(const fs::path& path, std::uintmax_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{} does not exist", path.string()));
  if (!fs::is_regular_file(status)) throw InputError(fmt::format("{} is not a file", path.string()));
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(fmt::format("cannot read {}: {}", path.string(), error.message()));
  if (size > max_bytes)
    throw InputError(
        fmt::format("{} has {} bytes, more than the {} allowed here", path.string(), size, max_bytes));
  std::string text(size, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (!in) throw InputError(fmt::format("cannot read {}", path.string()));
  return text;
}

TemporaryFolder::TemporaryFolder() : folder_(make_temporary_folder) {}

}  // namespace plenolab
