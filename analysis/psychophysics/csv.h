#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plenolab {

/// A CSV file (RFC 4180) with a header line, read strictly: what is not plainly right is refused with the
/// number of its line, so that no column is shifted and no row lost in silence.

struct CsvRow {
  int line = 0;  ///< of the file, where the row begins; 1-based
  std::vector<std::string> fields;
};

struct CsvTable {
  std::string name;  ///< of the file, for messages
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;

  bool has_column(std::string_view column) const;
  /// Throws InputError listing the columns there are.
  std::size_t column(std::string_view column) const;

  /// The field as text that is not empty, a whole number or a number in [low, high], or 0 or 1. Throw
  /// InputError with file, line, column and what stands there.
  const std::string& text(const CsvRow& row, std::string_view column) const;
  std::int64_t whole(const CsvRow& row, std::string_view column, std::int64_t low, std::int64_t high) const;
  double number(const CsvRow& row, std::string_view column, double low, double high) const;
  bool flag(const CsvRow& row, std::string_view column) const;
};

/// Lines end in LF or CRLF; a field in quotes may hold commas, line breaks and doubled quotes; a byte-order
/// mark is skipped. Throws InputError for a file without rows, a header with empty or repeated names, a row
/// with more or fewer fields than the header, an empty line before the end, quotes in the middle of a field
/// or left open, or a NUL character.
CsvTable parse_csv(std::string_view text, const std::string& name);

}  // namespace plenolab
