#include "experiments/sweep_outcome.h"

#include <algorithm>
#include <map>

#include "analysis/memory.h"
#include "analysis/pareto.h"

namespace plenolab {

namespace {

std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<long long>(&cell)) return std::to_string(*whole);
  return format_number(std::get<double>(cell));
}

std::string text_of(const ResultRow& row, const std::string& column) {
  const auto found = std::find_if(row.columns.begin(), row.columns.end(),
                                  [&](const auto& entry) { return entry.first == column; });
  return found == row.columns.end() ? "" : text_of(found->second);
}

std::string series_of(const ResultRow& row, const std::vector<std::string>& columns) {
  std::string title;
  for (const std::string& column : columns)
    title += (title.empty() ? "" : ", ") + column + " " + text_of(row, column);
  return title;
}

}  // namespace

void time_setting(SweepOutcome& outcome, const std::function<void()>& work, int runs) {
  outcome.peak_mib = peak_memory_mib(work);
  outcome.timing = time_repeated(work, {.runs = runs, .warm_up_runs = outcome.peak_mib ? 0 : 1});
}

void add_outcome_rows(ResultTable& table, const Columns& stimulus,
                      const std::vector<SweepOutcome>& outcomes) {
  std::vector<double> errors, seconds;
  for (const SweepOutcome& outcome : outcomes) {
    errors.push_back(outcome.error);
    seconds.push_back(outcome.timing.median_s);
  }
  const std::vector<bool> on_front = pareto_front(errors, seconds);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const SweepOutcome& outcome = outcomes[i];
    Columns columns = stimulus;
    columns.insert(columns.end(), outcome.setting.begin(), outcome.setting.end());
    add_measurement_rows(table, outcome.values, columns);
    add_timing_rows(table, outcome.timing, columns);
    if (outcome.peak_mib) table.add({"memory_peak_mib", *outcome.peak_mib, "MiB", columns});
    table.add({"on_pareto_front", on_front[i] ? 1.0 : 0.0, "1", columns});
  }
}

Plot plot_sweep(const ResultTable& rows, const SweepPlotDesign& design) {
  std::map<std::string, std::map<std::string, PlotPoint>> series;
  for (const ResultRow& row : rows.rows()) {
    const std::string label = text_of(row, design.label_column);
    PlotPoint& point = series[series_of(row, design.series_columns)][label];
    if (row.quantity == design.error_quantity) point.y = row.value;
    if (row.quantity == "seconds_median") point.x = row.value * 1000;
    if (row.quantity == "on_pareto_front") point.marked = row.value != 0;
    point.label = label;
  }
  Plot plot;
  plot.x = {.title = "Run time, median", .unit = "ms", .logarithmic = true};
  plot.y = {.title = design.error_title, .unit = design.error_unit, .logarithmic = true};
  plot.marked_title = "Pareto front";
  plot.key = KeyPosition::kOutside;
  for (const auto& [title, points] : series) {
    PlotSeries shown{.title = title};
    for (const auto& [label, point] : points)
      if (point.y > 0) shown.points.push_back(point);
    std::sort(shown.points.begin(), shown.points.end(),
              [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    if (!shown.points.empty()) plot.series.push_back(std::move(shown));
  }
  return plot;
}

}  // namespace plenolab
