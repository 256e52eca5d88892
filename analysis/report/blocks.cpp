#include "analysis/report/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"

namespace plenolab::detail {
namespace {

/// Tables of more columns are set smaller and closer, so that they fit the page.
constexpr std::size_t kColumnsAtEase = 7;

/// Decimals that give the numbers of a column the same number of places, if all are of about the same size
/// (none for whole numbers) or are shares, below 1 and none so small that it would read 0; otherwise each
/// number gets its own significant digits.
std::optional<int> common_decimals(const ReportTable& table, std::size_t column) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  bool whole = true;
  for (const auto& row : table.rows) {
    const double* number = std::get_if<double>(&row[column]);
    if (number == nullptr || !std::isfinite(*number) || *number == 0) continue;
    smallest = std::min(smallest, std::abs(*number));
    largest = std::max(largest, std::abs(*number));
    whole = whole && *number == std::round(*number);
  }
  if (!whole && largest < 1 && smallest >= std::pow(10.0, -table.digits)) return table.digits;
  if (largest == 0 || largest > 10 * smallest || largest >= 1e7 || smallest < 1e-4) return std::nullopt;
  if (whole) return 0;
  return std::max(0, table.digits - 1 - static_cast<int>(std::floor(std::log10(largest))));
}

std::string number_text(double number, int digits, std::optional<int> decimals) {
  return decimals && std::isfinite(number) ? fmt::format("{:.{}f}", number, *decimals)
                                           : format_number(number, digits);
}

/// A parameter as it was set.
std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<long long>(&cell)) return fmt::format("{}", *whole);
  return shortest_number(std::get<double>(cell));
}

std::string cell_html(const Cell& cell, int digits, std::optional<int> decimals) {
  if (const auto* text = std::get_if<std::string>(&cell))
    return fmt::format("<td>{}</td>", escape_html(*text));
  if (const auto* whole = std::get_if<long long>(&cell)) {
    return fmt::format("<td class=\"num\" data-v=\"{0}\">{0}</td>", *whole);
  }
  const double number = std::get<double>(cell);
  if (std::isnan(number)) throw InputError("a table holds NaN, which no result may be");
  return fmt::format("<td class=\"num\" data-v=\"{}\">{}</td>", shortest_number(number),
                     number_text(number, digits, decimals));
}

/// Whether a column holds numbers only (and some).
bool is_numeric(const ReportTable& table, std::size_t column) {
  for (const auto& row : table.rows) {
    const auto* text = std::get_if<std::string>(&row[column]);
    if (text != nullptr && !text->empty()) return false;
  }
  return !table.rows.empty();
}

void check_rows(const ReportTable& table) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i].size() != table.headings.size()) {
      throw InputError(fmt::format("row {} of table \"{}\" has {} cells for {} headings", i + 1,
                                   table.caption, table.rows[i].size(), table.headings.size()));
    }
  }
}

void check_images(const ImageComparison& comparison) {
  if (comparison.images.empty()) {
    throw InputError(fmt::format("the comparison \"{}\" has no images", comparison.caption));
  }
  const DisplayImage& first = comparison.images.front().image;
  for (const ReportImage& entry : comparison.images) {
    if (entry.image.empty()) throw InputError(fmt::format("image \"{}\" has no pixels", entry.label));
    if (entry.image.width() != first.width() || entry.image.height() != first.height()) {
      throw InputError(
          fmt::format("image \"{}\" has {}×{} pixels but \"{}\" has {}×{}; compare images of equal size",
                      entry.label, entry.image.width(), entry.image.height(), comparison.images.front().label,
                      first.width(), first.height()));
    }
  }
}

std::string png_bytes(const DisplayImage& image) {
  const TemporaryFolder folder;
  write_display_image(folder.path() / "image.png", image);
  return read_text_file(folder.path() / "image.png", std::uintmax_t{1} << 30);
}

std::string caption_html(const std::string& caption) {
  return caption.empty() ? "" : "<figcaption>" + escape_html(caption) + "</figcaption>";
}

std::string themed_image(const std::string& svg, const char* theme, const std::string& alt) {
  return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"{}\">", theme, escape_html(alt),
                     data_uri("image/svg+xml", svg));
}

void add_row(std::string& html, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  html +=
      fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape_html(name), escape_html(value));
}

std::string command_line_text(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) {
    const bool plain =
        !argument.empty() && argument.find_first_of(" \t\n\"'\\$`;&|<>*?()[]{}!#~") == std::string::npos;
    text += (text.empty() ? "" : " ") + (plain ? argument : fmt::format("'{}'", argument));
  }
  return text;
}

}  // namespace

std::string block_html(const Paragraph& paragraph) {
  std::string html = "<p>";
  const std::string text = escape_html(paragraph.text);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool blank_line = text.compare(i, 2, "\n\n") == 0;
    html += blank_line ? "</p>\n<p>" : std::string(1, text[i]);
    if (blank_line) ++i;
  }
  return html + "</p>\n";
}

std::string block_html(const ReportTable& table) {
  check_rows(table);
  const bool wide = table.headings.size() > kColumnsAtEase;
  std::string html = fmt::format("<div class=\"{}\"", wide ? "table wide" : "table") +
                     " tabindex=\"0\" role=\"region\" aria-label=\"" +
                     escape_html(table.caption.empty() ? "Table" : table.caption) +
                     "\"><table class=\"sortable\">\n";
  if (!table.caption.empty()) html += "<caption>" + escape_html(table.caption) + "</caption>\n";
  html += "<thead><tr>";
  for (std::size_t i = 0; i < table.headings.size(); ++i) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", is_numeric(table, i) ? " class=\"num\"" : "",
                        escape_html(table.headings[i]));
  }
  html += "</tr></thead>\n<tbody>\n";
  std::vector<std::optional<int>> decimals;
  for (std::size_t i = 0; i < table.headings.size(); ++i) decimals.push_back(common_decimals(table, i));
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) html += cell_html(row[i], table.digits, decimals[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string block_html(const ReportPlot& plot) {
  return "<figure><div class=\"plot\">" +
         themed_image(plot_svg(plot.plot, PlotTheme::kLight), "on-light", plot.alt) +
         themed_image(plot_svg(plot.plot, PlotTheme::kDark), "on-dark", plot.alt) + "</div>" +
         caption_html(plot.caption) + "</figure>\n";
}

std::string block_html(const ImageComparison& comparison) {
  check_images(comparison);
  std::string html =
      fmt::format("<figure class=\"compare\" data-alt=\"{}\"><div class=\"box\">\n<ul class=\"sources\">\n",
                  escape_html(comparison.alt));
  for (const ReportImage& entry : comparison.images) {
    const std::string label = escape_html(entry.label);
    html += fmt::format(
        "<li><img width=\"{}\" height=\"{}\" alt=\"{}: {}\" data-label=\"{}\" "
        "src=\"{}\"><span>{}</span></li>\n",
        entry.image.width(), entry.image.height(), label, escape_html(comparison.alt), label,
        data_uri("image/png", png_bytes(entry.image)), label);
  }
  return html + "</ul></div>" + caption_html(comparison.caption) + "</figure>\n";
}

std::string provenance_html(const Provenance& provenance) {
  const BuildInfo& build = provenance.build;
  const MachineInfo& machine = provenance.machine;
  std::string html =
      "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"Provenance\"><table "
      "class=\"provenance\"><tbody>\n";
  add_row(html, "Command", command_line_text(provenance.command_line));
  add_row(html, "Seed", provenance.seed ? std::to_string(*provenance.seed) : "");
  add_row(html, "Started", provenance.started_utc);
  add_row(html, "Duration", format_number(provenance.duration_s) + " s");
  add_row(html, "Peak memory", format_number(provenance.peak_memory_mib) + " MiB");
  add_row(html, "Revision",
          build.revision + (build.dirty ? " with local changes" : "") + ", version " + build.version);
  add_row(html, "Build", fmt::format("{}, {}, {}", build.compiler, build.build_type, build.flags));
  add_row(html, "Machine",
          fmt::format("{}, {} cores, {} GiB, {}", machine.cpu, machine.cores,
                      format_number(machine.memory_gib, 3), machine.os));
  for (const InputFile& input : provenance.inputs)
    add_row(html, "Input", input.path + " (XXH3 " + input.hash + ")");
  std::string parameters;
  for (const auto& [name, value] : provenance.parameters.items())
    parameters += (parameters.empty() ? "" : ", ") + name + " = " + text_of(value);
  if (!parameters.empty()) add_row(html, "Parameters", parameters);
  std::string libraries;
  for (const auto& [name, version] : provenance.libraries) {
    libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  }
  add_row(html, "Libraries", libraries);
  return html + "</tbody></table></div>\n";
}

}  // namespace plenolab::detail
