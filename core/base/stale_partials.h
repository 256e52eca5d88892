#pragma once

#include <chrono>
#include <filesystem>

namespace plenolab {

/// Removes files of a folder (not of those below it) that have a temporary name of write_atomically (file.h)
/// and have not been written to for `age`: what a process left behind that was killed in the middle. Whoever
/// still writes is much faster than an hour, on this machine or on another that shares the folder. Files that
/// cannot be removed stay. Returns how many went.
int remove_stale_partials(const std::filesystem::path& folder,
                          std::chrono::seconds age = std::chrono::hours(1));

}  // namespace plenolab
