#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/claims.h"
#include "analysis/plot.h"
#include "analysis/provenance.h"
#include "analysis/result_table.h"
#include "core/image/image.h"

namespace plenolab {

/// A report: one HTML file that needs nothing else (no network, no other file), for screens of any width,
/// light and dark, keyboard and print. All texts are plain text; everything is escaped.

/// A key figure in the summary on top.
struct KeyFigure {
  std::string label;  ///< e.g. "PSNR, median of 64 views"
  std::string value;  ///< e.g. "41.3"
  std::string unit;   ///< e.g. "dB"
  std::string note;   ///< smaller, below; may be empty
};

struct Paragraph {
  std::string text;  ///< blank lines separate paragraphs
};

/// A table that readers can sort by a click on a heading.
struct ReportTable {
  std::string caption;
  std::vector<std::string> headings;
  std::vector<std::vector<Cell>> rows;  ///< each as long as headings; numbers are right-aligned
  /// Significant digits of numbers that are not whole; a column of numbers of similar size (within a factor
  /// of 10) gets equal decimals, so that they line up.
  int digits = 4;
};

/// A figure; `alt` says in words what it shows, for readers who cannot see it.
struct ReportPlot {
  Plot plot;
  std::string caption, alt;
};

/// One image of a comparison.
struct ReportImage {
  std::string label;  ///< short, e.g. "Ground truth"
  DisplayImage image;
};

/// Images of equal size to compare: flip (keys 1 … 9), wipe, side by side, with common zoom and pan, pixel by
/// pixel, and coordinates and values under the pointer.
struct ImageComparison {
  std::string caption, alt;
  std::vector<ReportImage> images;  ///< at least one; equal sizes
};

/// The claims ledger with verdict badges.
struct ReportLedger {
  std::string caption;
  std::vector<LedgerEntry> entries;
};

using ReportBlock = std::variant<Paragraph, ReportTable, ReportPlot, ImageComparison, ReportLedger>;

struct ReportSection {
  std::string title;
  std::vector<ReportBlock> blocks;
  std::string chapter =
      {};  ///< that it belongs to; neighbours of one chapter stand under its name; may be empty
};

struct Report {
  std::string title;
  std::string subtitle;  ///< one sentence
  std::vector<KeyFigure> key_figures;
  std::vector<ReportSection> sections;
  std::optional<Provenance> provenance;  ///< becomes the last section, "Provenance"
};

/// The page. Throws InputError naming the section and block for a table with ragged rows, a comparison
/// without images or with different sizes, or an image with non-finite values.
std::string report_html(const Report& report);

/// Writes the page to a file.
void write_report(const Report& report, const std::filesystem::path& path);

/// Text with & < > " ' replaced so that it means itself in HTML text and attributes.
std::string escape_html(const std::string& text);

}  // namespace plenolab
