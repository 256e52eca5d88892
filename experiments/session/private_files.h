#pragma once

#include <filesystem>
#include <string>

namespace plenolab {

/// Files and folders for their owner alone, which survive a power cut.

/// How much is waited for.
enum class Durability {
  kPowerCut,    ///< synchronous=FULL: every event survives a power cut
  kProcessEnd,  ///< synchronous=OFF: survives the end of the program however it comes; for simulated
                ///< participants
};

/// Creates a folder 0700 with those above it, and waits until all are on the disk; one that exists stays as
/// it is.
void create_private_folder(const std::filesystem::path& folder);

/// Writes a file 0600 that must not exist yet, and waits until it is as durable as asked. It is there with
/// all of the text or not at all; until then it is FILE.partial.
void create_private_file(const std::filesystem::path& file, const std::string& text, Durability durability);

/// Makes the entries of a folder durable. File systems that cannot (EINVAL) keep them durable by themselves.
void sync_folder(const std::filesystem::path& folder);

}  // namespace plenolab
