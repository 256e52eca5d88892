#include "experiments/cli/wide_table.h"

#include <algorithm>
#include <map>

namespace plenolab {

namespace {

std::string cell_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<long long>(&cell)) return std::to_string(*whole);
  return format_number(std::get<double>(cell));
}

const Cell* find_column(const ResultRow& row, const std::string& name) {
  for (const auto& [column, cell] : row.columns)
    if (column == name) return &cell;
  return nullptr;
}

/// Terminal columns of UTF-8 text whose characters are one column wide.
std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

ReportTable wide_table(const ResultTable& results, const std::vector<std::string>& keys,
                       const std::vector<WideColumn>& quantities, std::string caption) {
  ReportTable table;
  table.caption = std::move(caption);
  table.headings = keys;
  for (const WideColumn& column : quantities) table.headings.push_back(column.heading);
  std::map<std::string, std::size_t> line_of_key;
  for (const ResultRow& row : results.rows()) {
    const auto quantity = std::find_if(quantities.begin(), quantities.end(),
                                       [&](const WideColumn& c) { return c.quantity == row.quantity; });
    if (quantity == quantities.end()) continue;
    std::vector<Cell> line(table.headings.size(), Cell{std::string{}});
    std::string key;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (const Cell* cell = find_column(row, keys[i])) line[i] = *cell;
      key += cell_text(line[i]) + '\x1f';
    }
    const auto [entry, is_new] = line_of_key.try_emplace(key, table.rows.size());
    if (is_new) table.rows.push_back(std::move(line));
    table.rows[entry->second][keys.size() + static_cast<std::size_t>(quantity - quantities.begin())] =
        row.value;
  }
  return table;
}

std::string to_wide_text(const ResultTable& results, const std::vector<std::string>& keys,
                         const std::vector<WideColumn>& quantities) {
  const ReportTable table = wide_table(results, keys, quantities);
  std::vector<std::vector<std::string>> lines{table.headings};
  for (const auto& row : table.rows) {
    std::vector<std::string>& line = lines.emplace_back();
    for (const Cell& cell : row) line.push_back(cell_text(cell));
  }
  std::vector<std::size_t> widths(table.headings.size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], display_width(line[i]));
  std::string text;
  for (const auto& line : lines) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string padding(widths[i] - display_width(line[i]), ' ');
      out += (i < keys.size() ? line[i] + padding : padding + line[i]) + "  ";
    }
    text += out.substr(0, out.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

}  // namespace plenolab
