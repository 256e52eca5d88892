#pragma once

#include <filesystem>
#include <functional>

namespace plenolab {

/// What to do with a folder that exists and is not empty.
enum class ExistingFolder {
  kRefuse,
  kReplace,  ///< put the new folder in its place at the end, then remove it with all that it holds
};

/// Runs `write` on a fresh folder beside `folder` and renames it to `folder`, so that it appears whole or not
/// at all; missing parents are created, links are followed. The temporary folder is removed on any exception
/// and on a stop signal (core/base/partial_output.h); what a killed process left of an earlier attempt at the
/// same folder is removed first, while that of a process still at work is left alone.
///
/// Throws InputError if `folder` is a file, the folder the process works in or above it, or the root of a
/// file system (it cannot be renamed), if it is not empty and not to be replaced, or if it cannot be created.
void write_folder_atomically(const std::filesystem::path& folder,
                             const std::function<void(const std::filesystem::path& temporary)>& write,
                             ExistingFolder existing = ExistingFolder::kRefuse);

}  // namespace plenolab
