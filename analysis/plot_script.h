#pragma once

#include <filesystem>
#include <string>

#include "analysis/plot.h"

namespace plenolab::detail {

/// What a gnuplot script draws to.
enum class PlotOutput { kSvgLight, kSvgDark, kPdf };

/// Data blocks of the figure, shared by all outputs of a script.
std::string plot_data_blocks(const Plot& plot);

/// Commands that draw the figure from these data blocks into `file` (in gnuplot's working folder).
std::string plot_commands(const Plot& plot, PlotOutput output, const std::string& file);

/// Text as a gnuplot string literal in single quotes, in which nothing is expanded; control characters become
/// spaces.
std::string gnuplot_quoted(const std::string& text);

}  // namespace plenolab::detail
