#pragma once

#include <string>

#include "analysis/plot_script.h"

namespace plenolab::detail {

/// Colours of everything but the data, "#rrggbb".
struct PlotInk {
  std::string text, axis, grid;
};

PlotInk plot_ink(PlotOutput output);

/// Colour, point type and dash type of the series at `index`; they repeat after eight.
struct SeriesStyle {
  std::string colour;
  int point_type = 7, dash_type = 1;
};

SeriesStyle series_style(std::size_t index, PlotOutput output);

/// Commands that open the terminal and style frame, grid and texts.
std::string terminal_commands(PlotOutput output, const std::string& file, int width_px, int height_px);

/// Title, range, scale and ticks of an axis ("x" or "y") whose data lie in [low, high].
std::string axis_commands(const std::string& name, const PlotAxis& axis, double low, double high);

/// "Run time [s]".
std::string axis_title(const PlotAxis& axis);

}  // namespace plenolab::detail
