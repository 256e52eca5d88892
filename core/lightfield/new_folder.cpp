#include "core/lightfield/new_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/base/partial_output.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// A folder held open. Its lock tells other processes that somebody is at work in it; the kernel lets go of
/// it when the process ends in whatever way.
class OpenFolder {
 public:
  explicit OpenFolder(const fs::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)) {}
  ~OpenFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFolder(OpenFolder&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFolder& operator=(OpenFolder&&) = delete;

  /// Waits for the lock. File systems without locks go without: nobody can then take the folder for
  /// abandoned.
  void lock() { ::flock(descriptor_, LOCK_EX); }
  /// False if somebody else has the lock, or if there are no locks here.
  bool try_lock() { return descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0; }
  /// Whether the folder is still to be found under its name.
  bool exists() const { return fs::exists(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  int descriptor_;
};

/// Where the folder really goes: "out/" and "out" are the same, and links are followed.
fs::path resolved(const fs::path& folder) {
  if (folder.empty()) throw InputError("cannot write a folder without a name");
  std::error_code error;
  const fs::path target = fs::weakly_canonical(fs::absolute(folder), error);
  if (error)
    throw InputError(fmt::format("cannot create the folder {}: {}", folder.string(), error.message()));
  return target.has_filename() ? target : target.parent_path();
}

bool is_root_of_file_system(const fs::path& folder) {
  struct stat own {
  }, above{};
  return ::stat(folder.c_str(), &own) == 0 && ::stat(folder.parent_path().c_str(), &above) == 0 &&
         (own.st_dev != above.st_dev || own.st_ino == above.st_ino);
}

bool is_at_or_above_working_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return !error &&
         std::mismatch(folder.begin(), folder.end(), here.begin(), here.end()).first == folder.end();
}

/// Throws unless the folder may be put where `target` is.
void check_free(const fs::path& target, const fs::path& named, ExistingFolder existing) {
  std::error_code error;
  if (!fs::exists(target, error)) return;
  const auto refuse = [&](const char* why) {
    throw InputError(fmt::format("{} {}: choose another name", named.string(), why));
  };
  if (!fs::is_directory(target, error)) refuse("exists and is not a folder");
  if (is_root_of_file_system(target))
    refuse("is the root of a file system, which cannot be put in place whole");
  if (is_at_or_above_working_folder(target)) refuse("is the folder you work in, or above it");
  if (existing == ExistingFolder::kRefuse && !fs::is_empty(target, error))
    refuse("exists and is not an empty folder");
}

std::string partial_prefix(const fs::path& target) {
  return fmt::format(".{}.partial-", target.filename().string());
}

/// Removes what killed processes left beside `target`.
void remove_abandoned(const fs::path& target) {
  const std::string prefix = partial_prefix(target);
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(target.parent_path(), error)) {
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    OpenFolder folder(entry.path());
    if (folder.try_lock()) fs::remove_all(folder.path(), error);
  }
}

/// A private folder beside `target` to work in.
fs::path make_workplace(const fs::path& target) {
  std::string name = (target.parent_path() / (partial_prefix(target) + "XXXXXX")).string();
  if (!::mkdtemp(name.data()))
    throw InputError(
        fmt::format("cannot create a folder in {}: {}", target.parent_path().string(), std::strerror(errno)));
  return name;
}

/// Locks the new folder; nothing if another process took it for abandoned in the moment before.
bool lock_own(OpenFolder& folder) {
  folder.lock();
  return folder.exists();
}

/// Puts `from` where `to` is. A full folder that was there ends in the workplace that `from` came from.
void exchange(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0) return;
  if (::rename(from.c_str(), to.c_str()) == 0) return;  // nothing or an empty folder was there
  if (errno != ENOTEMPTY && errno != EEXIST) throw std::system_error(errno, std::generic_category());
  // Not every file system can exchange: two steps then.
  const fs::path aside = from.string() + ".replaced";
  fs::rename(to, aside);
  fs::rename(from, to);
}

void put_in_place(const PartialOutput& workplace, const fs::path& from, const fs::path& target,
                  ExistingFolder existing) {
  workplace.put_in_place([&] {
    try {
      if (existing == ExistingFolder::kReplace)
        exchange(from, target);
      else
        fs::rename(from, target);
    } catch (const std::system_error& failed) {
      throw InputError(
          fmt::format("cannot create the folder {}: {}", target.string(), failed.code().message()));
    }
  });
}

}  // namespace

void write_folder_atomically(const fs::path& folder, const std::function<void(const fs::path&)>& write,
                             ExistingFolder existing) {
  const fs::path target = resolved(folder);
  check_free(target, folder, existing);
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  if (error)
    throw InputError(
        fmt::format("cannot create the folder {}: {}", target.parent_path().string(), error.message()));
  remove_abandoned(target);
  const PartialOutput workplace([&] { return make_workplace(target); });
  OpenFolder own(workplace.path());
  if (!lock_own(own))
    throw InputError(fmt::format("another process is about to write {}: try again", folder.string()));
  // The new folder lies inside the workplace, as may those of writers called by `write`: they all go at once.
  const fs::path fresh = workplace.path() / target.filename();
  fs::create_directory(fresh);
  write_under_temporary_name(fresh, folder, write);
  put_in_place(workplace, fresh, target, existing);
}

}  // namespace plenolab
