#include "analysis/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace plenolab {
namespace {

constexpr std::array<const char*, 4> kReserved{"quantity", "value", "unit", "value_text"};

const char* infinity_text(double value) {
  return value > 0 ? "infinity" : "-infinity";
}

void set_number(nlohmann::ordered_json& object, const std::string& key, double value) {
  if (std::isfinite(value)) {
    object[key] = value;
  } else {
    object[key] = nullptr;
    object[key + "_text"] = infinity_text(value);
  }
}

nlohmann::ordered_json row_to_json(const ResultRow& row) {
  nlohmann::ordered_json object;
  for (const auto& [name, cell] : row.columns) {
    if (const double* number = std::get_if<double>(&cell)) {
      set_number(object, name, *number);
    } else {
      std::visit([&, &key = name](const auto& value) { object[key] = value; }, cell);
    }
  }
  object["quantity"] = row.quantity;
  set_number(object, "value", row.value);
  object["unit"] = row.unit;
  return object;
}

const Cell* find_cell(const ResultRow& row, const std::string& name) {
  for (const auto& [key, cell] : row.columns) {
    if (key == name) return &cell;
  }
  return nullptr;
}

std::string csv_cell(const Cell* cell) {
  if (cell == nullptr) return "";
  if (const auto* text = std::get_if<std::string>(cell)) return csv_field(*text);
  if (const auto* whole = std::get_if<long long>(cell)) return std::to_string(*whole);
  return shortest_number(std::get<double>(*cell));
}

/// A cell as text for people, and whether it is a number.
struct TextCell {
  std::string text;
  bool number = false;
};

TextCell text_cell(const Cell* cell, int digits) {
  if (cell == nullptr) return {};
  if (const auto* text = std::get_if<std::string>(cell)) return {*text, false};
  if (const auto* whole = std::get_if<long long>(cell)) return {std::to_string(*whole), true};
  return {format_number(std::get<double>(*cell), digits), true};
}

/// Columns on screen taken by UTF-8 text without wide or combining characters.
std::size_t text_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string aligned(const std::vector<std::vector<TextCell>>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], text_width(line[i].text));
  }
  std::string out;
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string padding(widths[i] - text_width(line[i].text), ' ');
      row += (i > 0 ? "  " : "") + (line[i].number ? padding + line[i].text : line[i].text + padding);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    out += row + "\n";
  }
  return out;
}

}  // namespace

void ResultTable::add(ResultRow row) {
  PLENOLAB_CHECK(!row.quantity.empty(), "a result row needs a quantity");
  PLENOLAB_CHECK(!std::isnan(row.value), row.quantity + " is NaN");
  for (std::size_t i = 0; i < row.columns.size(); ++i) {
    const auto& [name, cell] = row.columns[i];
    PLENOLAB_CHECK(!name.empty() && std::find(kReserved.begin(), kReserved.end(), name) == kReserved.end(),
                   name);
    const double* number = std::get_if<double>(&cell);
    PLENOLAB_CHECK(number == nullptr || !std::isnan(*number), name + " is NaN");
    for (std::size_t j = 0; j < i; ++j) PLENOLAB_CHECK(row.columns[j].first != name, name + " occurs twice");
  }
  rows_.push_back(std::move(row));
}

void ResultTable::append(const ResultTable& other) {
  const std::vector<ResultRow> added = other.rows_;  // a copy, so that a table can be appended to itself
  rows_.insert(rows_.end(), added.begin(), added.end());
}

std::vector<std::string> ResultTable::column_names() const {
  std::vector<std::string> names;
  for (const ResultRow& row : rows_) {
    for (const auto& column : row.columns) {
      if (std::find(names.begin(), names.end(), column.first) == names.end()) names.push_back(column.first);
    }
  }
  return names;
}

nlohmann::ordered_json rows_to_json(const ResultTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ResultRow& row : table.rows()) rows.push_back(row_to_json(row));
  return rows;
}

std::string results_to_json_text(const nlohmann::ordered_json& run, const ResultTable& table) {
  nlohmann::ordered_json document;
  document["run"] = run;
  document["rows"] = rows_to_json(table);
  // Texts from outside (file names, arguments) may not be UTF-8: replaced, not refused.
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string to_csv(const ResultTable& table) {
  const std::vector<std::string> names = table.column_names();
  std::string out;
  for (const std::string& name : names) out += csv_field(name) + ",";
  out += "quantity,value,unit\r\n";
  for (const ResultRow& row : table.rows()) {
    for (const std::string& name : names) out += csv_cell(find_cell(row, name)) + ",";
    out += csv_field(row.quantity) + "," + shortest_number(row.value) + "," + csv_field(row.unit) + "\r\n";
  }
  return out;
}

std::string to_text(const ResultTable& table, int digits) {
  const std::vector<std::string> names = table.column_names();
  std::vector<std::vector<TextCell>> lines(1);
  for (const std::string& name : names) lines[0].push_back({name});
  for (const char* name : {"quantity", "value", "unit"}) lines[0].push_back({name});
  for (const ResultRow& row : table.rows()) {
    std::vector<TextCell> line;
    for (const std::string& name : names) line.push_back(text_cell(find_cell(row, name), digits));
    line.push_back({row.quantity});
    line.push_back({format_number(row.value, digits), true});
    line.push_back({row.unit == "1" ? "" : row.unit});
    // Headings stand over numbers as numbers do.
    for (std::size_t i = 0; i < line.size(); ++i) lines[0][i].number = lines[0][i].number || line[i].number;
    lines.push_back(std::move(line));
  }
  return aligned(lines);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string format_number(double value, int digits) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  const double magnitude = std::abs(value);
  if (magnitude < 1e-4 || magnitude >= 1e7) return fmt::format("{:.{}e}", value, digits - 1);
  const int before_point = static_cast<int>(std::floor(std::log10(magnitude))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::max(0, digits - before_point));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string shortest_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

}  // namespace plenolab
