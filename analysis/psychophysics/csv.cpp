#include "analysis/psychophysics/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "core/base/error.h"

namespace plenolab {

namespace {

/// Walks through the text field by field.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    if (text_.find('\0') != std::string_view::npos) fail("holds a NUL character: it is not a text file");
  }

  bool at_end() const { return position_ >= text_.size(); }

  CsvRow next_row() {
    CsvRow row{line_, {}};
    do row.fields.push_back(next_field());
    while (take(','));
    end_line();
    return row;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", name_, line_, what));
  }
  bool take(char c) {
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  std::string next_field() {
    if (take('"')) return quoted_field();
    const std::size_t end = std::min(text_.find_first_of(",\"\r\n", position_), text_.size());
    if (end < text_.size() && text_[end] == '"') fail("a quote stands in the middle of a field");
    std::string field(text_.substr(position_, end - position_));
    position_ = end;
    return field;
  }
  std::string quoted_field() {
    std::string field;
    while (!at_end()) {
      const char c = text_[position_++];
      if (c == '\n') ++line_;
      if (c != '"')
        field += c;
      else if (take('"'))
        field += '"';
      else
        return field;
    }
    fail("a quote is never closed");
  }
  void end_line() {
    if (at_end()) return;
    const bool carriage_return = take('\r');
    if (!take('\n') && !(carriage_return && at_end()))
      fail(carriage_return ? "a carriage return stands in the middle of a line"
                           : "something stands behind a closing quote");
    ++line_;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
  int line_ = 1;
};

bool is_blank(const CsvRow& row) {
  return row.fields.size() == 1 && row.fields[0].empty();
}

void check_header(const CsvTable& table) {
  std::set<std::string> seen;
  for (const std::string& column : table.columns) {
    if (column.empty()) throw InputError(fmt::format("{}, line 1: a column has no name", table.name));
    if (!seen.insert(column).second)
      throw InputError(fmt::format("{}, line 1: two columns are called '{}'", table.name, column));
  }
}

[[noreturn]] void fail_field(const CsvTable& table, const CsvRow& row, std::string_view column,
                             const std::string& wanted, const std::string& field) {
  throw InputError(
      fmt::format("{}, line {}: '{}' must be {}, not '{}'", table.name, row.line, column, wanted, field));
}

template <class Number>
bool parse_whole(const std::string& field, Number& value) {
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  return result.ec == std::errc{} && result.ptr == end;
}

}  // namespace

bool CsvTable::has_column(std::string_view column_name) const {
  return std::find(columns.begin(), columns.end(), column_name) != columns.end();
}

std::size_t CsvTable::column(std::string_view column_name) const {
  const auto found = std::find(columns.begin(), columns.end(), column_name);
  if (found == columns.end())
    throw InputError(
        fmt::format("{} has no column '{}': it has {}", name, column_name, fmt::join(columns, ", ")));
  return static_cast<std::size_t>(found - columns.begin());
}

const std::string& CsvTable::text(const CsvRow& row, std::string_view column_name) const {
  const std::string& field = row.fields[column(column_name)];
  if (field.empty()) throw InputError(fmt::format("{}, line {}: '{}' is empty", name, row.line, column_name));
  return field;
}

std::int64_t CsvTable::whole(const CsvRow& row, std::string_view column_name, std::int64_t low,
                             std::int64_t high) const {
  const std::string& field = row.fields[column(column_name)];
  std::int64_t value = 0;
  if (!parse_whole(field, value) || value < low || value > high)
    fail_field(*this, row, column_name, fmt::format("a whole number from {} to {}", low, high), field);
  return value;
}

double CsvTable::number(const CsvRow& row, std::string_view column_name, double low, double high) const {
  const std::string& field = row.fields[column(column_name)];
  double value = 0;
  if (!parse_whole(field, value) || !(value >= low && value <= high))
    fail_field(*this, row, column_name, fmt::format("a number from {:g} to {:g}", low, high), field);
  return value;
}

bool CsvTable::flag(const CsvRow& row, std::string_view column_name) const {
  const std::string& field = row.fields[column(column_name)];
  if (field != "0" && field != "1") fail_field(*this, row, column_name, "0 or 1", field);
  return field == "1";
}

CsvTable parse_csv(std::string_view text, const std::string& name) {
  CsvTable table{name, {}, {}};
  Reader reader(text, table.name);
  if (!reader.at_end()) table.columns = reader.next_row().fields;
  check_header(table);
  int blank_line = 0;
  while (!reader.at_end()) {
    CsvRow row = reader.next_row();
    if (blank_line > 0) throw InputError(fmt::format("{}, line {}: the line is empty", name, blank_line));
    if (is_blank(row)) {
      blank_line = row.line;
      continue;
    }
    if (row.fields.size() != table.columns.size())
      throw InputError(fmt::format("{}, line {}: {} fields instead of the {} that the header names", name,
                                   row.line, row.fields.size(), table.columns.size()));
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw InputError(fmt::format("{} holds no rows below a header line", name));
  return table;
}

}  // namespace plenolab
