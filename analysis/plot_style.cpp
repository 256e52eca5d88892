#include "analysis/plot_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "analysis/result_table.h"

namespace plenolab::detail {
namespace {

/// The first three on light pages are blue, vermillion and bluish green of Okabe & Ito (2008), a set made for
/// all kinds of colour vision. Their other colours are too pale for a white page or too dark for a dark one:
/// the others here are darker or lighter neighbours of them and not part of that set.
constexpr std::array<const char*, 8> kLightPage{"#0072b2", "#d55e00", "#009e73", "#aa4499",
                                                "#b8860b", "#2f96d2", "#7a5195", "#6b7280"};
constexpr std::array<const char*, 8> kDarkPage{"#56a8e8", "#f0803c", "#2fc49a", "#e08fc6",
                                               "#e6b34a", "#9bd3f5", "#b89be0", "#a3acb8"};
constexpr std::array<int, 8> kPointTypes{7, 5, 9, 11, 13, 15, 6, 4};
constexpr std::array<int, 8> kDashTypes{1, 2, 4, 5, 1, 2, 4, 5};

/// Multiples of powers of ten in [low, high].
std::vector<double> decade_ticks(double low, double high, std::initializer_list<double> multiples) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low))),
            last = static_cast<int>(std::ceil(std::log10(high)));
  for (int decade = first; decade <= last; ++decade) {
    for (const double multiple : multiples) {
      const double value = multiple * std::pow(10.0, decade);
      if (value >= low && value <= high) ticks.push_back(value);
    }
  }
  return ticks;
}

/// At least three steps of 1, 2 or 5 times a power of ten, evenly apart.
std::vector<double> even_ticks(double low, double high) {
  const double least = (high - low) / 8, power = std::pow(10.0, std::floor(std::log10(least)));
  const double step = power * (least <= power ? 1 : least <= 2 * power ? 2 : least <= 5 * power ? 5 : 10);
  std::vector<double> ticks;
  for (double k = std::ceil(low / step); k <= std::floor(high / step); ++k) ticks.push_back(k * step);
  return ticks;
}

/// Ticks of a logarithmic axis of less than three decades, where gnuplot would label one or two: the
/// coarsest that put at least three labels on it.
std::vector<double> log_ticks(double low, double high) {
  constexpr std::size_t kEnough = 3;
  std::vector<double> ticks = decade_ticks(low, high, {1, 2, 5});
  if (ticks.size() < kEnough) ticks = decade_ticks(low, high, {1, 1.5, 2, 3, 4, 5, 7});
  return ticks.size() < kEnough && high > low ? even_ticks(low, high) : ticks;
}

std::string tick_list(const std::vector<double>& ticks) {
  std::string text;
  for (const double value : ticks)
    text += fmt::format("{}'{:.10g}' {:.10g}", text.empty() ? "" : ", ", value, value);
  return text;
}

std::string bound(const std::optional<double>& value) {
  return value ? shortest_number(*value) : "*";
}

}  // namespace

PlotInk plot_ink(PlotOutput output) {
  if (output == PlotOutput::kSvgDark) return {"#d5dae1", "#7d8794", "#353c46"};
  return {"#2b3138", "#8a929c", "#dde1e6"};
}

SeriesStyle series_style(std::size_t index, PlotOutput output) {
  const std::size_t i = index % kLightPage.size();
  return {output == PlotOutput::kSvgDark ? kDarkPage[i] : kLightPage[i], kPointTypes[i], kDashTypes[i]};
}

std::string terminal_commands(PlotOutput output, const std::string& file, int width_px, int height_px) {
  const PlotInk ink = plot_ink(output);
  std::string text = "reset\nset encoding utf8\n";
  if (output == PlotOutput::kPdf) {
    text += fmt::format("set terminal pdfcairo enhanced size {},{} font 'sans-serif,10' rounded\n",
                        width_px / 96.0, height_px / 96.0);
  } else {
    text += fmt::format("set terminal svg enhanced size {},{} font 'sans-serif,14' rounded\n", width_px,
                        height_px);
  }
  text += fmt::format("set output {}\n", gnuplot_quoted("./" + file));
  text += fmt::format("set border 3 linecolor rgb '{}' linewidth 1\n", ink.axis);
  text += fmt::format("set grid linetype 1 linewidth 0.7 linecolor rgb '{}'\n", ink.grid);
  text += fmt::format("set tics nomirror out scale 0.6,0.3 textcolor rgb '{}' noenhanced\n", ink.text);
  text += fmt::format("set xlabel textcolor rgb '{0}'\nset ylabel textcolor rgb '{0}'\n", ink.text);
  text += fmt::format("set title textcolor rgb '{}'\n", ink.text);
  text += fmt::format("set key textcolor rgb '{}' noenhanced samplen 2 spacing 1.15\n", ink.text);
  return text;
}

std::string axis_commands(const std::string& name, const PlotAxis& axis, double low, double high) {
  std::string text = fmt::format("set {}label {} noenhanced\n", name, gnuplot_quoted(axis_title(axis)));
  text += fmt::format("set {}range [{}:{}]\n", name, bound(axis.minimum), bound(axis.maximum));
  if (!axis.logarithmic) return text;
  text += fmt::format("set logscale {}\n", name);
  low = axis.minimum.value_or(low), high = axis.maximum.value_or(high);
  if (std::log10(high / low) < 3) {
    // Automatic ranges end on labelled ticks only if gnuplot chose these; widen by hand.
    const double margin = std::pow(std::max(1.0, high / low), 0.08) * 1.05;
    if (!axis.minimum) low /= margin;
    if (!axis.maximum) high *= margin;
    text += fmt::format("set {0}range [{1}:{2}]\nset {0}tics ({3})\n", name, shortest_number(low),
                        shortest_number(high), tick_list(log_ticks(low, high)));
  } else {
    text += fmt::format("set format {0} '10^{{%T}}'\nset {0}tics enhanced\n", name);
  }
  return text;
}

std::string axis_title(const PlotAxis& axis) {
  return axis.unit.empty() || axis.unit == "1" ? axis.title : fmt::format("{} [{}]", axis.title, axis.unit);
}

}  // namespace plenolab::detail
