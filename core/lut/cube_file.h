#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/lut/curves.h"
#include "core/lut/lut.h"

namespace plenolab {

/// The text format .cube of look-up tables (Adobe, Cube LUT Specification 1.0).

/// What a .cube file holds: a lattice, curves, or curves (a shaper) whose outputs enter the lattice.
struct CubeContent {
  std::optional<LutCurves> curves;
  std::optional<Lut> lattice;
  std::string title;
};

/// Reads a file: LUT_3D_SIZE, LUT_1D_SIZE, or both, the one-dimensional nodes first (DaVinci Resolve; the
/// specification knows one of them). Accepted besides the specification: lines longer than 250 characters, a
/// byte order mark, CR LF, a sign before a number, and LUT_1D_INPUT_RANGE and LUT_3D_INPUT_RANGE (low high)
/// in place of DOMAIN_MIN and DOMAIN_MAX, as grading programs write it; beside curves the domain of the file
/// is theirs. Throws InputError in one sentence with `name` and the line: missing or surplus nodes, numbers
/// that are not finite or beyond kLargestLutNumber, sizes outside 2 … 256 (2 … 65536 of curves), unknown
/// keywords (they might change what the numbers mean), and files that are no text. Memory is taken only for
/// nodes that the text can hold.
CubeContent parse_cube_content(std::string_view text, const std::string& name);

/// Output of one colour by all that the file holds: curves exactly, then the lattice. Pure.
Rgb sample_content(const CubeContent& content, Rgb colour, LutInterpolation interpolation);

/// The same as one lattice, that of lut_of_curves where there are curves; `size` as there.
Lut lut_of_content(const CubeContent& content, int size = 0);

/// Both together.
Lut parse_cube(std::string_view text, const std::string& name);

/// The table as text; numbers are the shortest that read back exactly, the domain is left out if it is 0 … 1.
/// Throws InputError for an invalid table or a title with a quote or line break.
std::string cube_text(const Lut& lut);

/// Reads a .cube file of any kind.
CubeContent read_cube_content(const std::filesystem::path& path);

/// Reads or writes a table by the file's extension: .cube, or .png for an image strip (strip_file.h). Throws
/// InputError for others.
Lut read_lut(const std::filesystem::path& path);
void write_lut(const std::filesystem::path& path, const Lut& lut);

}  // namespace plenolab
