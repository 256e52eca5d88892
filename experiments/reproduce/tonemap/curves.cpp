#include "experiments/reproduce/tonemap/curves.h"

#include <cmath>

#include "core/base/error.h"

namespace plenolab {

std::vector<double> log_spaced(double low, double high, int count) {
  PLENOLAB_CHECK(low > 0 && low < high && count >= 2, "0 < low < high, two numbers at least");
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(low * std::pow(high / low, i / (count - 1.0)));
  return x;
}

PlotSeries curve_series(std::string title, std::span<const double> x,
                        const std::function<double(double)>& function) {
  PlotSeries series{.title = std::move(title), .style = PlotSeries::Style::kLines, .points = {}};
  for (const double at : x) series.points.push_back({.x = at, .y = function(at)});
  return series;
}

SteepestPlace steepest_place(std::span<const double> x, const std::function<double(double)>& function) {
  PLENOLAB_CHECK(!x.empty(), "a place at least");
  constexpr double kStepLog10 = 0.002;
  const double ratio = std::pow(10.0, kStepLog10);
  SteepestPlace steepest{-1e300, 0};
  for (const double at : x) {
    const double slope = (function(at * ratio) - function(at / ratio)) / (2 * kStepLog10);
    if (slope > steepest.slope + 1e-9) steepest = {slope, at};
  }
  return steepest;
}

}  // namespace plenolab
