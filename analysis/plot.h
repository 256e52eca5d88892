#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plenolab {

/// Figures, all drawn by gnuplot (no other engine) from one description. Series never differ by colour alone:
/// points differ in shape and lines in dash, bars stand in the order of the key. Every colour has a contrast
/// of at least 3 : 1 with the page (WCAG 2.1, 1.4.11).

struct PlotPoint {
  double x = 0, y = 0;                  ///< finite; > 0 on logarithmic axes
  std::optional<double> y_low, y_high;  ///< error bar; both or neither
  std::string label;                    ///< written beside the point
  bool marked = false;                  ///< ringed, e.g. on the Pareto front
};

struct PlotSeries {
  enum class Style { kLines, kPoints, kLinesPoints };
  std::string title;  ///< in the key; empty = not listed
  Style style = Style::kLinesPoints;
  std::vector<PlotPoint> points;
};

struct PlotAxis {
  std::string title;  ///< e.g. "Run time"
  std::string unit;   ///< written in brackets behind the title; empty or "1" = none
  bool logarithmic = false;
  std::optional<double> minimum, maximum;  ///< automatic where absent
};

/// Where the key stands: outside right keeps it off the data.
enum class KeyPosition { kTopRight, kTopLeft, kBottomRight, kBottomLeft, kOutside, kNone };

/// A figure of points and lines, or of bars where `categories` is not empty: then every series has one point
/// for each category, in order (x is not used); bars stand side by side, series of kLines are lines across.
struct Plot {
  std::string title;  ///< empty = none (captions of a report say it)
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<std::string> categories;
  std::string marked_title;  ///< key entry of the ringed points, e.g. "Pareto front"
  KeyPosition key = KeyPosition::kTopRight;
  int width_px = 720, height_px = 430;

  /// Throws InputError naming what cannot be drawn: no points, a non-finite number, a number ≤ 0 on a
  /// logarithmic axis, series that do not fit the categories.
  void validate() const;
};

/// Ink for a light or a dark page; the background is transparent.
enum class PlotTheme { kLight, kDark };

/// The figure as SVG text, deterministic byte for byte. Throws InputError if gnuplot is missing or fails,
/// with its message.
std::string plot_svg(const Plot& plot, PlotTheme theme = PlotTheme::kLight);

/// The files of one figure.
struct PlotFiles {
  std::filesystem::path script, data, svg, svg_dark, pdf;
};

/// Writes stem.gp (redraws the SVG and PDF in its folder), stem.csv, stem.svg, stem-dark.svg and stem.pdf.
PlotFiles write_plot(const Plot& plot, const std::filesystem::path& stem);

}  // namespace plenolab
