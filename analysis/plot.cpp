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

std::string plot_svg(const Plot& plot, PlotTheme theme) {
  plot.validate();
  const PlotOutput output = theme == PlotTheme::kLight ? PlotOutput::kSvgLight : PlotOutput::kSvgDark;
  const TemporaryFolder folder;
  run_gnuplot(detail::plot_data_blocks(plot) + detail::plot_commands(plot, output, "figure.svg"),
              folder.path());
  return read_text_file(folder.path() / "figure.svg");
}

PlotFiles write_plot(const Plot& plot, const std::filesystem::path& stem) {
  plot.validate();
  const auto file = [&](const char* suffix) { return std::filesystem::path(stem.string() + suffix); };
  const PlotFiles files{file(".gp"), file(".csv"), file(".svg"), file("-dark.svg"), file(".pdf")};
  const std::string script =
      "# Redraws the figures beside it: gnuplot -d " + files.script.filename().string() + "\n" +
      detail::plot_data_blocks(plot) +
      detail::plot_commands(plot, PlotOutput::kSvgLight, files.svg.filename().string()) +
      detail::plot_commands(plot, PlotOutput::kSvgDark, files.svg_dark.filename().string()) +
      detail::plot_commands(plot, PlotOutput::kPdf, files.pdf.filename().string());
  const TemporaryFolder folder;
  run_gnuplot(script, folder.path());
  write_text_file(files.script, script);
  write_text_file(files.data, csv_of(plot));
  for (const auto& drawn : {files.svg, files.svg_dark, files.pdf}) {
    write_text_file(drawn, read_text_file(folder.path() / drawn.filename()));
  }
  return files;
}

}  // namespace plenolab
