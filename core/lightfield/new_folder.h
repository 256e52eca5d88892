#pragma once

#include <filesystem>
#include <functional>

namespace plenolab {

/// Runs `write` on a fresh folder beside `folder` and renames it to `folder`, so that it appears whole or not
/// at all; missing parents are created, the temporary folder is removed on any exception. Throws InputError
/// if `folder` exists and is anything but an empty folder.
void write_folder_atomically(const std::filesystem::path& folder,
                             const std::function<void(const std::filesystem::path& temporary)>& write);

}  // namespace plenolab
