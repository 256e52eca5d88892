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
/// all of the text or not at all; until then it is FILE.XXXXXX.partial, a name of its own for each program
/// that wants to write it. Throws InputError if there is one, or it cannot be written.
void create_private_file(const std::filesystem::path& file, const std::string& text, Durability durability);

/// Whether this is what a program that was cut off left of FILE.
bool is_partial_of(const std::filesystem::path& file, const std::filesystem::path& candidate);

/// Removes what programs that were cut off left of FILE. Nobody may be writing it.
void remove_partial_files(const std::filesystem::path& file);

/// Makes the entries of a folder durable. File systems that cannot (EINVAL) keep them durable by themselves.
void sync_folder(const std::filesystem::path& folder);

}  // namespace plenolab
