#include "analysis/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/plot_script.h"
#include "analysis/result_table.h"
#include "analysis/subprocess.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {

using detail::PlotOutput;

void check_number(double value, const PlotAxis& axis, const std::string& series) {
  if (!std::isfinite(value)) {
    throw InputError(
        fmt::format("series \"{}\" holds {} for {}; leave such points out", series, value, axis.title));
  }
  if (axis.logarithmic && value <= 0) {
    throw InputError(
        fmt::format("series \"{}\" holds {} on the logarithmic axis {}; use a linear axis or leave the "
                    "point out",
                    series, value, axis.title));
  }
}

void check_axis(const PlotAxis& axis) {
  for (const auto& bound : {axis.minimum, axis.maximum}) {
    if (bound) check_number(*bound, axis, "range of the axis");
  }
  if (axis.minimum && axis.maximum && !(*axis.minimum < *axis.maximum)) {
    throw InputError(
        fmt::format("the range of axis {} is empty: {} … {}", axis.title, *axis.minimum, *axis.maximum));
  }
}

void check_size(int width_px, int height_px) {
  if (width_px < 100 || height_px < 100 || width_px > 10000 || height_px > 10000) {
    throw InputError(
        fmt::format("a figure of {}×{} px cannot be drawn; use 100 … 10000", width_px, height_px));
  }
}

void check_point(const Plot& plot, const PlotSeries& series, const PlotPoint& point) {
  if (plot.categories.empty()) check_number(point.x, plot.x, series.title);
  check_number(point.y, plot.y, series.title);
  if (point.y_low.has_value() != point.y_high.has_value()) {
    throw InputError(fmt::format("series \"{}\" has a point with half an error bar", series.title));
  }
  if (point.y_low) {
    check_number(*point.y_low, plot.y, series.title);
    check_number(*point.y_high, plot.y, series.title);
  }
}

/// Runs gnuplot on a script in a folder.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  write_text_file(folder / "script.gp", script);
  // -d: no start-up files of the user, which would change figures.
  const ProcessResult result = run_process({"gnuplot", "-d", "script.gp"}, folder);
  if (result.exit_code != 0) {
    throw InputError(fmt::format("gnuplot failed with exit code {}: {}", result.exit_code, result.output));
  }
}

std::string draw(const std::string& data, const std::string& commands, const std::string& file) {
  const TemporaryFolder folder;
  run_gnuplot(data + commands, folder.path());
  return read_text_file(folder.path() / file);
}

template <class Figure>
std::string svg_of(const Figure& figure, PlotTheme theme) {
  figure.validate();
  const PlotOutput output = theme == PlotTheme::kLight ? PlotOutput::kSvgLight : PlotOutput::kSvgDark;
  return draw(detail::plot_data_blocks(figure), detail::plot_commands(figure, output, "figure.svg"),
              "figure.svg");
}

std::string csv_of(const Plot& plot) {
  std::string text = plot.categories.empty() ? "series,x,y,y_low,y_high,label,marked\r\n"
                                             : "series,category,y,y_low,y_high,label,marked\r\n";
  for (const PlotSeries& series : plot.series) {
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const PlotPoint& p = series.points[i];
      const std::string x = plot.categories.empty() ? shortest_number(p.x) : csv_field(plot.categories[i]);
      text += fmt::format("{},{},{},{},{},{},{}\r\n", csv_field(series.title), x, shortest_number(p.y),
                          p.y_low ? shortest_number(*p.y_low) : "",
                          p.y_high ? shortest_number(*p.y_high) : "", csv_field(p.label), p.marked ? 1 : 0);
    }
  }
  return text;
}

std::string csv_of(const HeatMap& map) {
  std::string text = "x,y,value\r\n";
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    text +=
        fmt::format("{},{},{}\r\n", shortest_number(map.x_values[i % map.x_values.size()]),
                    shortest_number(map.y_values[i / map.x_values.size()]), shortest_number(map.values[i]));
  }
  return text;
}

template <class Figure>
PlotFiles write_figure(const Figure& figure, const std::filesystem::path& stem) {
  figure.validate();
  const auto file = [&](const char* suffix) { return std::filesystem::path(stem.string() + suffix); };
  const PlotFiles files{file(".gp"), file(".csv"), file(".svg"), file("-dark.svg"), file(".pdf")};
  const std::string script =
      "# Redraws the figures beside it: gnuplot -d " + files.script.filename().string() + "\n" +
      detail::plot_data_blocks(figure) +
      detail::plot_commands(figure, PlotOutput::kSvgLight, files.svg.filename().string()) +
      detail::plot_commands(figure, PlotOutput::kSvgDark, files.svg_dark.filename().string()) +
      detail::plot_commands(figure, PlotOutput::kPdf, files.pdf.filename().string());
  const TemporaryFolder folder;
  run_gnuplot(script, folder.path());
  write_text_file(files.script, script);
  write_text_file(files.data, csv_of(figure));
  for (const auto& drawn : {files.svg, files.svg_dark, files.pdf}) {
    write_text_file(drawn, read_text_file(folder.path() / drawn.filename()));
  }
  return files;
}

}  // namespace

void Plot::validate() const {
  check_size(width_px, height_px);
  check_axis(x);
  check_axis(y);
  if (series.empty()) throw InputError("a figure without series cannot be drawn");
  for (const PlotSeries& one : series) {
    if (one.points.empty()) throw InputError(fmt::format("series \"{}\" has no points to draw", one.title));
    if (!categories.empty() && one.points.size() != categories.size()) {
      throw InputError(fmt::format("series \"{}\" has {} points for {} categories", one.title,
                                   one.points.size(), categories.size()));
    }
    for (const PlotPoint& point : one.points) check_point(*this, one, point);
  }
}

void HeatMap::validate() const {
  check_size(width_px, height_px);
  if (x.logarithmic || y.logarithmic) throw InputError("heat maps have linear axes only");
  if (x_values.empty() || y_values.empty() || values.size() != x_values.size() * y_values.size()) {
    throw InputError(fmt::format("a heat map of {}×{} cells needs as many values, not {}", x_values.size(),
                                 y_values.size(), values.size()));
  }
  for (const auto* centres : {&x_values, &y_values}) {
    for (std::size_t i = 0; i < centres->size(); ++i) {
      check_number((*centres)[i], centres == &x_values ? x : y, "cell centres");
      if (i > 0 && !((*centres)[i - 1] < (*centres)[i]))
        throw InputError("cell centres of a heat map must ascend");
    }
  }
  for (const double v : values) check_number(v, {value_title, "", false, {}, {}}, "cells");
}

std::string plot_svg(const Plot& plot, PlotTheme theme) {
  return svg_of(plot, theme);
}
std::string plot_svg(const HeatMap& map, PlotTheme theme) {
  return svg_of(map, theme);
}
PlotFiles write_plot(const Plot& plot, const std::filesystem::path& stem) {
  return write_figure(plot, stem);
}
PlotFiles write_plot(const HeatMap& map, const std::filesystem::path& stem) {
  return write_figure(map, stem);
}

}  // namespace plenolab
