#include "experiments/batch/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/pareto.h"
#include "analysis/statistics.h"
#include "experiments/batch/report_pictures.h"
#include "experiments/batch/summary.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/wide_table.h"

namespace plenolab {

namespace {

using Stored = std::vector<StoredItem>;

const char* plural(std::size_t count) {
  return count == 1 ? "" : "s";
}

std::string better_text(const MetricQuantity& quantity) {
  switch (quantity.better) {
    case Better::kHigher:
      return "higher is better";
    case Better::kLower:
      return "lower is better";
    case Better::kNearerZero:
      return "nearer to 0 is better";
    case Better::kNeither:
      return "neither high nor low is better";
  }
  return "";
}

std::size_t count_of(const Stored& stored, ItemState state) {
  return static_cast<std::size_t>(std::count_if(stored.begin(), stored.end(),
                                                [&](const StoredItem& item) { return item.state == state; }));
}

std::vector<KeyFigure> key_figures(const BatchPlan& plan, const Stored& stored) {
  double seconds = 0;
  for (const StoredItem& item : stored) seconds += item.result.seconds_with_metrics();
  const std::size_t failed = count_of(stored, ItemState::kFailed);
  return {{"items done", std::to_string(count_of(stored, ItemState::kDone)), "",
           fmt::format("of {}{}", plan.items.size(),
                       failed == 0 ? std::string() : fmt::format("; {} failed", failed))},
          {"inputs", std::to_string(plan.inputs.size()), "", ""},
          {"operators", std::to_string(plan.operators.size()), "", ""},
          {"mapping and metrics took", seconds < 1 ? "under 1 s" : format_duration(seconds), "",
           "all items and all runs added up; the time on top of the page is that of the last run"}};
}

ReportSection failure_section(const BatchPlan& plan, const Stored& stored) {
  ReportSection section{"What failed", {}, {}};
  ReportTable table{
      "Items without numbers, or without those of some metrics; they are tried again at the next run",
      {"item", "why"},
      {}};
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (stored[i].state == ItemState::kFailed)
      table.rows.push_back({plan.title(plan.items[i]), stored[i].result.failures()});
  section.blocks.emplace_back(std::move(table));
  return section;
}

/// A metric's name with an arrow to where better values of its first quantity lie.
std::string with_arrow(const Metric& metric) {
  const Better better = metric.quantities.front().better;
  return metric.name + (better == Better::kHigher ? " ↑" : better == Better::kLower ? " ↓" : "");
}

/// Of inputs of different sizes nothing but time for a number of pixels can be compared.
constexpr const char* kTimeHeading = "ms/Mpx";

ReportSection summary_section(const BatchPlan& plan, const Stored& stored, const ResultTable& means) {
  ReportSection section{"Operators in short", {}, {}};
  std::vector<WideColumn> columns{{"items", "items"}};
  for (const Metric* metric : plan.metrics)
    columns.push_back({metric->quantities.front().name, with_arrow(*metric)});
  columns.push_back({"ms_per_megapixel", kTimeHeading});
  section.blocks.emplace_back(wide_table(
      means, {"operator"}, columns,
      "First quantity of each metric (↑ higher, ↓ lower is better): mean over the views of each input that "
      "all "
      "operators have, then over the inputs, so that each counts alike; time: median over inputs of "
      "statistics, fit and mapping, a fit for several views shared among these"));
  for (const std::string& note : exposure_notes(plan, stored)) section.blocks.emplace_back(Paragraph{note});
  for (const std::string& note : comparison_notes(plan, stored)) section.blocks.emplace_back(Paragraph{note});
  return section;
}

bool is_adjusted(const BatchOperator& op) {
  return op.choice.adjusted;
}

ReportSection mapping_section(const BatchPlan& plan, const ResultTable& means) {
  ReportSection section{"What the mapping changed", {}, {}};
  section.blocks.emplace_back(wide_table(
      means, {"operator"},
      {{"mean_luma", "mean luma"},
       {"clipped_high_share", "cut to 1 [share]"},
       {"clipped_low_share", "cut to 0 [share]"},
       {"floored_pixels", "luminance 0 [px]"},
       {"repaired_nan", "NaN [values]"},
       {"repaired_infinite", "infinite [values]"},
       {"repaired_negative", "negative [values]"},
       {"left_out_pixels", "not measured [px]"}},
      "Means over inputs, of the views that all operators have: nothing is cut, repaired or left out "
      "silently; shares are of the channel values"));
  if (std::any_of(plan.operators.begin(), plan.operators.end(), is_adjusted))
    section.blocks.emplace_back(wide_table(
        means, {"operator"},
        {{"correspondences_per_pixel", "corresponding pixels of a pixel"},
         {"kept_dark", "too dark to adjust [px]"},
         {"adjusted_clipped_high", "cut to 1 [values]"},
         {"adjusted_floored_pixels", "luminance 0 [px]"},
         {"hdr_repairs", "repaired in the scene [values]"},
         {"display_repairs", "repaired as mapped [values]"}},
        "Of key-view adjustment, all views of a light field together: means over the inputs measured"));
  return section;
}

ReportTable quantity_table(const Metric& metric, const ResultTable& means) {
  const std::string prefix = metric.name + "_";
  std::vector<WideColumn> columns;
  for (const MetricQuantity& quantity : metric.quantities) {
    const std::string& name = quantity.name;
    columns.push_back({name, (name.starts_with(prefix) ? name.substr(prefix.size()) : name) +
                                 (quantity.unit == "1" ? "" : " [" + quantity.unit + "]")});
  }
  return wide_table(
      means, {"operator"}, columns,
      fmt::format("Means over inputs, of the views that all operators have; in results.csv names "
                  "begin with {}",
                  prefix));
}

/// Mean over the views of an input that are compared, or why there is none.
Cell mean_cell(const BatchPlan& plan, const Stored& stored, std::size_t input, std::size_t op,
               const ComparedItems& compared, const std::string& quantity) {
  if (!compared.results[op].empty()) return mean(values_of(compared.results[op], quantity));
  std::size_t done = 0, measured = 0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (plan.items[i].input != input || plan.items[i].op != op || !stored[i].mapped()) continue;
    ++done;
    measured += values_of({&stored[i].result}, quantity).size();
  }
  return std::string(done == 0 ? "failed" : measured == 0 ? "left out" : "no view like the others");
}

std::string row_title(const BatchInput& input, const ComparedItems& compared) {
  const std::size_t views = std::max<std::size_t>(input.views.size(), 1);
  if (compared.views == 0 || compared.views == views) return title_of(input);
  return fmt::format("{} ({} of {} views)", title_of(input), compared.views, views);
}

/// The operators with the best value of a row, all of several; empty if there is nothing to compare.
std::string best_of(const BatchPlan& plan, const std::vector<Cell>& row, Better better) {
  const auto score = [&](std::size_t op) -> std::optional<double> {
    const double* const value = std::get_if<double>(&row[op + 1]);
    if (!value) return std::nullopt;
    return better == Better::kHigher ? *value : better == Better::kLower ? -*value : -std::abs(*value);
  };
  std::optional<double> best;
  for (std::size_t op = 0; op < plan.operators.size(); ++op)
    if (const auto value = score(op); value && (!best || *value > *best)) best = value;
  std::string titles;
  for (std::size_t op = 0; best && op < plan.operators.size(); ++op)
    if (score(op) == best) titles += (titles.empty() ? "" : ", ") + plan.operators[op].title();
  return titles;
}

ReportTable input_table(const BatchPlan& plan, const Stored& stored, const MetricQuantity& quantity) {
  ReportTable table{fmt::format("{} of each input, mean over those of its views that all operators have ({})",
                                quantity.name, better_text(quantity)),
                    {"input"},
                    {}};
  for (const BatchOperator& op : plan.operators) table.headings.push_back(op.title());
  const bool ordered = quantity.better != Better::kNeither && plan.operators.size() > 1;
  if (ordered) table.headings.emplace_back("best");
  for (std::size_t input = 0; input < plan.inputs.size(); ++input) {
    std::vector<Cell>& row = table.rows.emplace_back();
    const ComparedItems compared = compared_items(plan, stored, quantity.name, input);
    row.emplace_back(row_title(plan.inputs[input], compared));
    for (std::size_t op = 0; op < plan.operators.size(); ++op)
      row.push_back(mean_cell(plan, stored, input, op, compared, quantity.name));
    if (ordered) row.emplace_back(best_of(plan, row, quantity.better));
  }
  return table;
}

/// One point for each operator: medians over the means of inputs, with the extremes of the quantity.
ReportPlot time_plot(const BatchPlan& plan, const Stored& stored, const MetricQuantity& quantity) {
  ReportPlot plot;
  std::vector<double> times, values;
  const ComparedItems compared = compared_items(plan, stored, quantity.name);
  for (std::size_t op = 0; op < plan.operators.size(); ++op) {
    const std::vector<const ItemResult*>& results = compared.results[op];
    const std::vector<double> all = means_of_inputs(compared, values_of(results, quantity.name));
    if (all.empty()) continue;
    times.push_back(median(means_of_inputs(compared, milliseconds_per_megapixel(results))));
    values.push_back(median(all));
    plot.plot.series.push_back({plan.operators[op].title(),
                                PlotSeries::Style::kPoints,
                                {{.x = times.back(),
                                  .y = values.back(),
                                  .y_low = *std::min_element(all.begin(), all.end()),
                                  .y_high = *std::max_element(all.begin(), all.end())}}});
  }
  const bool ordered = quantity.better == Better::kHigher || quantity.better == Better::kLower;
  const Goal goal = quantity.better == Better::kHigher ? Goal::kMaximise : Goal::kMinimise;
  if (ordered) {
    const std::vector<bool> front = pareto_front(values, goal, times, Goal::kMinimise);
    for (std::size_t i = 0; i < front.size(); ++i) plot.plot.series[i].points.front().marked = front[i];
    plot.plot.marked_title = "Pareto front";
  }
  plot.plot.x = {.title = "Statistics, fit and mapping", .unit = "ms/megapixel", .logarithmic = true};
  plot.plot.y = {.title = quantity.name, .unit = quantity.unit};
  plot.plot.key = KeyPosition::kOutside;
  plot.plot.width_px = 960;  // the key takes a third
  plot.caption = fmt::format(
      "{} ({}) over run time: medians over inputs, each the mean of its views, of the {} view{} that all "
      "operators have; bars reach from the lowest to the highest input.",
      quantity.name, better_text(quantity), compared.views, plural(compared.views));
  plot.alt = fmt::format("{} of {} operators over their run time.", quantity.name, plot.plot.series.size());
  return plot;
}

ReportSection metric_section(const BatchPlan& plan, const Stored& stored, const ResultTable& means,
                             const Metric& metric, BatchReport& report) {
  ReportSection section{metric.name, {}, {}};
  const MetricQuantity& first = metric.quantities.front();
  section.blocks.emplace_back(Paragraph{fmt::format("{} {}: {}", metric.summary, first.name, first.meaning)});
  ReportPlot plot = time_plot(plan, stored, first);
  if (plot.plot.series.size() > 1) {  // one point compares nothing
    report.plots.emplace_back(metric.name + kOverTime, plot.plot);
    section.blocks.emplace_back(std::move(plot));
  }
  section.blocks.emplace_back(input_table(plan, stored, first));
  if (metric.quantities.size() > 1) section.blocks.emplace_back(quantity_table(metric, means));
  return section;
}

}  // namespace

BatchReport batch_report(const BatchPlan& plan, const Stored& stored, const std::filesystem::path& folder,
                         const Provenance& provenance) {
  BatchReport report;
  const ResultTable means = operator_rows(plan, stored);
  report.page.title = plan.study.title;
  report.page.subtitle =
      fmt::format("Chosen views of {} input{}, mapped by {} operator{} and measured by {} metric{}.",
                  plan.inputs.size(), plural(plan.inputs.size()), plan.operators.size(),
                  plural(plan.operators.size()), plan.metrics.size(), plural(plan.metrics.size()));
  report.page.key_figures = key_figures(plan, stored);
  if (count_of(stored, ItemState::kFailed) > 0) report.page.sections.push_back(failure_section(plan, stored));
  report.page.sections.push_back(summary_section(plan, stored, means));
  report.page.sections.push_back(picture_section(plan, stored, folder));
  for (const Metric* metric : plan.metrics)
    report.page.sections.push_back(metric_section(plan, stored, means, *metric, report));
  report.page.sections.push_back(mapping_section(plan, means));
  report.page.provenance = provenance;
  return report;
}

}  // namespace plenolab
