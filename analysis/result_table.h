#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace plenolab {

/// Value of an identifying column: text, a whole number or a number.
using Cell = std::variant<std::string, long long, double>;

/// One measured number with everything that identifies it. The value may be infinite (the PSNR of equal
/// images) but not NaN.
struct ResultRow {
  std::string quantity;  ///< stable name, e.g. "psnr_gamma_db", "seconds_median"
  double value = 0;
  std::string unit;  ///< "dB", "s", "1" …
  std::vector<std::pair<std::string, Cell>>
      columns;  ///< scene, view, method, setting … in order; names unique
};

/// Rows of one run, in order.
class ResultTable {
 public:
  /// Throws std::logic_error if the value is NaN, a name is empty or used twice, or is one of quantity,
  /// value, unit, value_text.
  void add(ResultRow row);
  /// Adds all rows of another table behind those here.
  void append(const ResultTable& other);

  const std::vector<ResultRow>& rows() const { return rows_; }
  bool empty() const { return rows_.empty(); }
  /// Names of all identifying columns, in the order of first use.
  std::vector<std::string> column_names() const;

 private:
  std::vector<ResultRow> rows_;
};

/// Flat JSON objects in an array: identifying columns, then quantity, value, unit. An infinite number is
/// null, with "value_text" (columns: "<name>_text") saying "infinity" or "-infinity".
nlohmann::ordered_json rows_to_json(const ResultTable& table);

/// {"run": run, "rows": […]}, two spaces of indentation, a newline at the end. `run` from provenance_to_json.
std::string results_to_json_text(const nlohmann::ordered_json& run, const ResultTable& table);

/// Tidy CSV (RFC 4180: CRLF, quotes where needed): all identifying columns, then quantity, value, unit.
/// Absent cells are empty; infinite numbers are "inf" and "-inf", as R and Python read them. Numbers in the
/// shortest form that reads back.
std::string to_csv(const ResultTable& table);

/// Aligned text for people: columns as in CSV, numbers right-aligned with `digits` significant digits,
/// infinite ones as ∞. UTF-8.
std::string to_text(const ResultTable& table, int digits = 4);

/// One field of a CSV file: quoted if it holds a comma, quote or line break.
std::string csv_field(const std::string& text);

/// A number for people: `digits` significant digits, without trailing zeros after the point, ∞ for infinity,
/// scientific below 1e-4 and from 1e7 on.
std::string format_number(double value, int digits = 4);

/// Shortest decimal text that reads back as the same double; "inf", "-inf", "nan" where not finite.
std::string shortest_number(double value);

}  // namespace plenolab
