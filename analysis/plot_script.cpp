#include "analysis/plot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "analysis/plot_style.h"
#include "analysis/result_table.h"

namespace plenolab::detail {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
};

bool is_bar_chart(const Plot& plot) {
  return !plot.categories.empty();
}

/// Series of style kLines are lines across a bar chart, e.g. a limit; all others are its bars.
bool is_line_across(const Plot& plot, const PlotSeries& series) {
  return is_bar_chart(plot) && series.style == PlotSeries::Style::kLines;
}

/// Number of bars before this series in a category; of all for the number of series.
std::size_t bars_before(const Plot& plot, std::size_t series) {
  const auto first = plot.series.begin();
  return series - static_cast<std::size_t>(
                      std::count_if(first, first + static_cast<std::ptrdiff_t>(series),
                                    [&](const PlotSeries& s) { return is_line_across(plot, s); }));
}

/// Bars stand at 1, 2, 3 …, those of one category side by side.
double bar_width(const Plot& plot) {
  return 0.8 / static_cast<double>(std::max<std::size_t>(1, bars_before(plot, plot.series.size())));
}

double x_of(const Plot& plot, std::size_t series, std::size_t point) {
  if (!is_bar_chart(plot)) return plot.series[series].points[point].x;
  if (is_line_across(plot, plot.series[series])) return static_cast<double>(point + 1);
  const double middle = 0.5 * static_cast<double>(bars_before(plot, plot.series.size()) - 1);
  return static_cast<double>(point + 1) +
         (static_cast<double>(bars_before(plot, series)) - middle) * bar_width(plot);
}

template <class Visit>
void for_each_point(const Plot& plot, const Visit& visit) {
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    for (std::size_t i = 0; i < plot.series[s].points.size(); ++i)
      visit(x_of(plot, s, i), plot.series[s].points[i]);
  }
}

Range range_x(const Plot& plot) {
  Range range;
  for_each_point(plot, [&](double x, const PlotPoint&) { range.add(x); });
  return range;
}

Range range_y(const Plot& plot) {
  Range range;
  for_each_point(plot, [&](double, const PlotPoint& p) {
    range.add(p.y);
    if (p.y_low) range.add(*p.y_low), range.add(*p.y_high);
  });
  return range;
}

std::string block(const std::string& name, const std::string& lines) {
  return "$" + name + " << EOD\n" + lines + "EOD\n";
}

bool has_marks(const Plot& plot) {
  bool found = false;
  for_each_point(plot, [&](double, const PlotPoint& p) { found = found || p.marked; });
  return found;
}

bool has_bars(const PlotSeries& series) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [](const PlotPoint& p) { return p.y_low.has_value(); });
}

std::string key_command(KeyPosition key) {
  switch (key) {
    case KeyPosition::kTopRight:
      return "set key top right\n";
    case KeyPosition::kTopLeft:
      return "set key top left Left reverse\n";
    case KeyPosition::kBottomRight:
      return "set key bottom right\n";
    case KeyPosition::kBottomLeft:
      return "set key bottom left Left reverse\n";
    case KeyPosition::kOutside:
      return "set key outside right top Left reverse\n";
    case KeyPosition::kNone:
      break;
  }
  return "unset key\n";
}

std::string label_commands(const Plot& plot, const PlotInk& ink) {
  std::string text;
  for_each_point(plot, [&](double x, const PlotPoint& p) {
    if (p.label.empty()) return;
    text += fmt::format(
        "set label {} at first {}, first {} left offset character 0.8,0.5 noenhanced textcolor rgb '{}'\n",
        gnuplot_quoted(p.label), shortest_number(x), shortest_number(p.y), ink.text);
  });
  return text;
}

std::string category_commands(const Plot& plot) {
  std::string ticks;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < plot.categories.size(); ++i) {
    ticks += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_quoted(plot.categories[i]), i + 1);
    longest = std::max(longest, plot.categories[i].size());
  }
  // About 8 px a character: turn names that would run into each other.
  const bool crowded = static_cast<double>(longest * plot.categories.size()) * 8 > plot.width_px * 0.85;
  return fmt::format("set xrange [0.4:{}]\nset xtics ({}){}\nset grid noxtics\n",
                     static_cast<double>(plot.categories.size()) + 0.6, ticks,
                     crowded ? " rotate by -35" : "");
}

std::string axes(const Plot& plot) {
  const Range x = range_x(plot), y = range_y(plot);
  PlotAxis y_axis = plot.y;
  // Bars are lengths: they start at zero where the axis has one.
  if (is_bar_chart(plot) && !y_axis.logarithmic && !y_axis.minimum && y.low >= 0) y_axis.minimum = 0;
  std::string text = axis_commands("y", y_axis, y.low, y.high);
  if (!is_bar_chart(plot)) return text + axis_commands("x", plot.x, x.low, x.high);
  PlotAxis title = plot.x;
  title.logarithmic = false;
  return text + axis_commands("x", title, x.low, x.high) + category_commands(plot);
}

std::string series_commands(const Plot& plot, std::size_t index, PlotOutput output) {
  const PlotSeries& series = plot.series[index];
  const SeriesStyle style = series_style(index, output);
  const std::string title = series.title.empty() ? "notitle" : "title " + gnuplot_quoted(series.title);
  const std::string colour = fmt::format("linecolor rgb '{}'", style.colour);
  std::string text;
  if (has_bars(series)) {
    const std::string bar_colour =
        is_bar_chart(plot) ? fmt::format("linecolor rgb '{}'", plot_ink(output).text) : colour;
    // Not "yerrorbars": these erase the page around each point, which shows on transparent figures.
    text = fmt::format(
        "$bars{} using 1:3:(0):($4-$3) with vectors heads size screen 0.006,90 {} linewidth 1.2 notitle",
        index, bar_colour);
  }
  std::string body;
  if (is_bar_chart(plot) && !is_line_across(plot, series)) {
    body = fmt::format("$series{} using 1:2 with boxes {} fillstyle solid 0.85 noborder {}", index, colour,
                       title);
    return text.empty() ? body : body + ", \\\n  " + text;
  }
  const char* with = series.style == PlotSeries::Style::kLines    ? "lines"
                     : series.style == PlotSeries::Style::kPoints ? "points"
                                                                  : "linespoints";
  body = fmt::format("$series{} using 1:2 with {} {}", index, with, colour);
  if (series.style != PlotSeries::Style::kPoints)
    body += fmt::format(" linewidth 2 dashtype {}", style.dash_type);
  if (series.style != PlotSeries::Style::kLines)
    body += fmt::format(" pointtype {} pointsize 0.75", style.point_type);
  body += " " + title;
  return text.empty() ? body : text + ", \\\n  " + body;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return quoted + "'";
}

std::string plot_data_blocks(const Plot& plot) {
  std::string text, marks;
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    std::string values, bars;
    const bool across = is_line_across(plot, plot.series[s]);
    if (across) values += "0.4 " + shortest_number(plot.series[s].points.front().y) + "\n";
    for (std::size_t i = 0; i < plot.series[s].points.size(); ++i) {
      const PlotPoint& p = plot.series[s].points[i];
      const std::string line = shortest_number(x_of(plot, s, i)) + " " + shortest_number(p.y);
      values += line + "\n";
      if (p.y_low) bars += line + " " + shortest_number(*p.y_low) + " " + shortest_number(*p.y_high) + "\n";
      if (p.marked) marks += line + "\n";
    }
    if (across)
      values += shortest_number(static_cast<double>(plot.categories.size()) + 0.6) + " " +
                shortest_number(plot.series[s].points.back().y) + "\n";
    text += block(fmt::format("series{}", s), values);
    if (!bars.empty()) text += block(fmt::format("bars{}", s), bars);
  }
  return marks.empty() ? text : text + block("marks", marks);
}

std::string plot_commands(const Plot& plot, PlotOutput output, const std::string& file) {
  const PlotInk ink = plot_ink(output);
  std::string text = terminal_commands(output, file, plot.width_px, plot.height_px);
  if (!plot.title.empty()) text += fmt::format("set title {} noenhanced\n", gnuplot_quoted(plot.title));
  text += key_command(plot.key) + axes(plot) + label_commands(plot, ink);
  if (is_bar_chart(plot))
    text += fmt::format("set boxwidth {} absolute\n", shortest_number(0.92 * bar_width(plot)));
  text += "plot ";
  for (std::size_t s = 0; s < plot.series.size(); ++s)
    text += (s > 0 ? ", \\\n  " : "") + series_commands(plot, s, output);
  if (has_marks(plot)) {
    text += fmt::format(
        ", \\\n  $marks using 1:2 with points linecolor rgb '{}' linewidth 1.5 pointtype 6 pointsize 1.7 {}",
        ink.text, plot.marked_title.empty() ? "notitle" : "title " + gnuplot_quoted(plot.marked_title));
  }
  return text + "\nset output\n";
}

}  // namespace plenolab::detail
