#pragma once

#include <filesystem>
#include <string>

#include "core/lightfield/light_field_folder.h"

namespace plenolab {

/// What a folder of EXR files does not say itself. Columns, rows, width and height are found from the files.
struct BareFolderOptions {
  double spacing_x_m = 0.1, spacing_y_m = 0.1;
  double fov_h_deg = 60;
  RadianceUnit unit = RadianceUnit::kRelative;
  std::string r, g, b;  ///< channel names; all empty: R, G, B or the only layer that ends in .R, .G, .B
  std::string
      depth;  ///< planar depth in metres; empty: the only channel named Z, depth or ending in .Z, .depth
  std::string pattern;  ///< view names with {column} and {row}; empty: found from the numbers in the names
  bool column_first = false;  ///< for names with two numbers: the first one is the column, not the row
  int columns = 0;            ///< for names with a single running number (row by row): the number of columns
  std::size_t memory_bound_bytes = LightField::kDefaultMemoryBound;
  /// Throws InputError for values out of range.
  void validate() const;
};

/// Opens a folder of EXR files with depth but without lightfield.json. File names must differ only in one or
/// two numbers, which then run over a full rectangle (from 0, 1 or any other first number on). Throws
/// InputError if no such pattern, or no unambiguous channel, is found; the message says which option decides
/// it.
LightField import_bare_folder(const std::filesystem::path& folder, const BareFolderOptions& options);

}  // namespace plenolab
