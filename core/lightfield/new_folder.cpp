#include "core/lightfield/new_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

void check_free(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder, error))) return;
  if (!fs::is_directory(folder, error) || !fs::is_empty(folder, error))
    throw InputError(fmt::format("{} exists and is not an empty folder: choose another name or remove it",
                                 folder.string()));
}

fs::path make_sibling(const fs::path& folder) {
  const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
  std::error_code error;
  fs::create_directories(parent, error);
  if (error)
    throw InputError(fmt::format("cannot create the folder {}: {}", parent.string(), error.message()));
  std::string name = (parent / fmt::format(".{}.partial-XXXXXX", folder.filename().string())).string();
  if (!::mkdtemp(name.data()))
    throw InputError(fmt::format("cannot create a folder in {}: {}", parent.string(), std::strerror(errno)));
  // mkdtemp makes private folders; results are for the group as the user's other files are.
  fs::permissions(name,
                  fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                      fs::perms::others_read | fs::perms::others_exec,
                  error);
  return name;
}

}  // namespace

void write_folder_atomically(const fs::path& folder, const std::function<void(const fs::path&)>& write) {
  // "out/" and "out" mean the same folder.
  const fs::path target = folder.has_filename() ? folder : folder.parent_path();
  check_free(target);
  const fs::path temporary = make_sibling(target);
  std::error_code error;
  try {
    write(temporary);
    fs::rename(temporary, target, error);
    if (error)
      throw InputError(fmt::format("cannot create the folder {}: {}", target.string(), error.message()));
  } catch (...) {
    fs::remove_all(temporary, error);
    throw;
  }
}

}  // namespace plenolab
