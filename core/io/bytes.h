#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plenolab {

/// All bytes of a regular file of at most `max_bytes`. Throws InputError if it is missing, no file, or
/// larger.
std::vector<std::byte> read_bytes(const std::filesystem::path& path, std::uint64_t max_bytes);

/// The first bytes of a regular file, at most `count`. Throws InputError.
std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::uint64_t count);

/// Size of a regular file. Throws InputError if there is none.
std::uint64_t size_of_file(const std::filesystem::path& path);

/// Lower-case extension with its dot, ".exr".
std::string lower_extension(const std::filesystem::path& path);

}  // namespace plenolab
