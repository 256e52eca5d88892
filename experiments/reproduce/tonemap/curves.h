#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/plot.h"

namespace plenolab {

/// `count` ≥ 2 numbers at equal ratios from `low` to `high`, both included; 0 < low < high.
std::vector<double> log_spaced(double low, double high, int count);

/// The line of a function through these places.
PlotSeries curve_series(std::string title, std::span<const double> x,
                        const std::function<double(double)>& function);

/// Where a function of luminance rises most steeply over log10 luminance.
struct SteepestPlace {
  double slope = 0;  ///< per log10 unit
  double x = 0;      ///< first such place
};

/// Central differences at the places x, 1/500 log10 unit to either side. At least one place, all > 0.
SteepestPlace steepest_place(std::span<const double> x, const std::function<double(double)>& function);

}  // namespace plenolab
