#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/lut/lut.h"

namespace plenolab {

/// The text format .cube of look-up tables (Adobe, Cube LUT Specification 1.0).

/// Reads a three-dimensional table. Accepted besides the specification: lines longer than 250 characters, a
/// byte order mark, CR LF, a sign before a number, and LUT_3D_INPUT_RANGE (low high) in place of DOMAIN_MIN
/// and DOMAIN_MAX, as grading programs write it. Throws InputError in one sentence with `name` and the line:
/// one-dimensional tables, missing or surplus nodes, numbers that are not finite, sizes outside 2 … 256,
/// unknown keywords (they might change what the numbers mean), and files that are no text. Memory is taken
/// only for nodes that the text can hold.
Lut parse_cube(std::string_view text, const std::string& name);

/// The table as text; numbers are the shortest that read back exactly, the domain is left out if it is 0 … 1.
/// Throws InputError for an invalid table or a title with a quote or line break.
std::string cube_text(const Lut& lut);

/// Reads or writes a table by the file's extension: .cube, or .png for an image strip (strip_file.h). Throws
/// InputError for others.
Lut read_lut(const std::filesystem::path& path);
void write_lut(const std::filesystem::path& path, const Lut& lut);

}  // namespace plenolab
