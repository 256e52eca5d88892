#include "experiments/session/private_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "core/base/error.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kPartial = ".partial";

void sync(int descriptor, const fs::path& path) {
  if (::fsync(descriptor) != 0)
    throw InputError(fmt::format("cannot store {} safely: {}", path.string(), std::strerror(errno)));
}

/// Gives a file its name unless the name is taken; false if it is.
bool rename_to_free_name(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  // A file system without renameat2's flag: the same in two steps.
  if (::link(from.c_str(), to.c_str()) != 0) return false;
  ::unlink(from.c_str());
  return true;
}

}  // namespace

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced)
    throw InputError(fmt::format("cannot store {} safely: {}", folder.string(), std::strerror(reason)));
}

void create_private_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (folder.has_parent_path() && folder.has_relative_path()) create_private_folder(folder.parent_path());
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw InputError(fmt::format("cannot create the folder {}: {}", folder.string(), std::strerror(errno)));
  sync_folder(folder.parent_path());
}

void create_private_file(const fs::path& file, const std::string& text, Durability durability) {
  const auto failed = [&] {
    return InputError(fmt::format("cannot create {}: {}", file.string(), std::strerror(errno)));
  };
  errno = EEXIST;
  if (fs::exists(file)) throw failed();
  std::string partial = file.string() + ".XXXXXX" + kPartial;
  const int descriptor = ::mkostemps(partial.data(), static_cast<int>(std::strlen(kPartial)), O_CLOEXEC);
  if (descriptor < 0) throw failed();
  const std::shared_ptr<void> unlinker(nullptr, [&](void*) { ::unlink(partial.c_str()); });
  const std::shared_ptr<void> closer(nullptr, [descriptor](void*) { ::close(descriptor); });
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + written, text.size() - written);
    if (count < 0) throw failed();
    written += static_cast<std::size_t>(count);
  }
  if (durability == Durability::kPowerCut) sync(descriptor, file);
  if (!rename_to_free_name(partial, file)) throw failed();
  if (durability == Durability::kPowerCut) sync_folder(file.parent_path());
}

bool is_partial_of(const fs::path& file, const fs::path& candidate) {
  const std::string name = candidate.filename().string();
  return name.starts_with(file.filename().string() + ".") && name.ends_with(kPartial);
}

void remove_partial_files(const fs::path& file) {
  std::vector<fs::path> partial;
  for (const auto& entry : fs::directory_iterator(file.has_parent_path() ? file.parent_path() : "."))
    if (is_partial_of(file, entry.path())) partial.push_back(entry.path());
  for (const fs::path& path : partial) fs::remove(path);
}

}  // namespace plenolab
