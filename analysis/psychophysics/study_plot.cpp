#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/psychophysics/study_table.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

/// Adds `name` unless it is there; its place.
std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

bool equal_trials(const Study& study) {
  return std::all_of(study.rows.begin(), study.rows.end(), [&](const StudyRow& row) {
    return row.count.chose_test.trials == study.rows.front().count.chose_test.trials;
  });
}

/// One bar for each image on the display.
PlotSeries bars_of(const Study& study, const std::string& display, const std::vector<std::string>& images,
                   double scale) {
  PlotSeries series{display, PlotSeries::Style::kPoints, std::vector<PlotPoint>(images.size())};
  for (const StudyRow& row : study.rows) {
    if (row.count.display != display) continue;
    const auto image = std::find(images.begin(), images.end(), row.count.image) - images.begin();
    PlotPoint& point = series.points[static_cast<std::size_t>(image)];
    point.y = scale * row.rate.estimate;
    point.y_low = scale * row.rate.low;
    point.y_high = scale * row.rate.high;
  }
  return series;
}

PlotSeries line_at(const std::string& title, const std::vector<double>& heights) {
  PlotSeries series{title, PlotSeries::Style::kLines, {}};
  for (const double y : heights) series.points.push_back({.x = 0, .y = y});
  return series;
}

/// The share (or number) to reach at each image: the largest of its displays.
std::vector<double> critical_heights(const Study& study, const std::vector<std::string>& images,
                                     double scale) {
  std::vector<double> heights(images.size(), 0);
  for (const StudyRow& row : study.rows) {
    const auto image = std::find(images.begin(), images.end(), row.count.image) - images.begin();
    double& height = heights[static_cast<std::size_t>(image)];
    height = std::max(
        height, scale * static_cast<double>(row.critical) / static_cast<double>(row.count.chose_test.trials));
  }
  return heights;
}

}  // namespace

Plot study_plot(const Study& study, bool counts) {
  if (counts && !equal_trials(study))
    throw InputError(
        "numbers of choices cannot be drawn to one scale: the images have different numbers of trials");
  std::vector<std::string> images, displays;
  for (const StudyRow& row : study.rows)
    place_of(images, row.count.image), place_of(displays, row.count.display);
  const double scale = counts ? static_cast<double>(study.rows.front().count.chose_test.trials) : 1;
  Plot plot;
  plot.x = {.title = "Image"};
  plot.y = {.title = counts ? "Choices of the test image" : "Share of choices of the test image",
            .minimum = 0,
            .maximum = scale};
  plot.categories = images;
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  for (const std::string& display : displays) plot.series.push_back(bars_of(study, display, images, scale));
  const std::vector<double> heights = critical_heights(study, images, scale);
  plot.series.push_back(line_at(equal_trials(study)
                                    ? fmt::format("to pass: {} of {}", study.rows.front().critical,
                                                  study.rows.front().count.chose_test.trials)
                                    : "to pass",
                                heights));
  plot.series.push_back(line_at("guessing", std::vector<double>(images.size(), scale * 0.5)));
  return plot;
}

}  // namespace plenolab
