#include "experiments/calibration/calibration_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/calibration/calibration_results.h"

namespace plenolab {

namespace {

/// Each (kind, reading) that occurs, in order of appearance.
std::vector<std::pair<std::string, std::string>> sources_in(const CalibrationFit& fit) {
  std::vector<std::pair<std::string, std::string>> sources;
  for (const FittedReading& r : fit.readings) {
    const std::pair source{r.kind, r.kind == "anchor" ? std::string() : r.what};
    if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(source);
  }
  return sources;
}

PlotSeries level(double y, double from, double to, const std::string& title) {
  return {title, PlotSeries::Style::kLines, {{from, y}, {to, y}}};
}

std::string unit_in(const std::string& reading) {
  const std::size_t at = reading.rfind('_');
  return at == std::string::npos ? "" : reading.substr(at + 1);
}

std::string without_unit(const std::string& reading) {
  return reading.substr(0, reading.rfind('_'));
}

/// Where a reading stands on the axis of records: its record's number; anchors follow the last record.
double place_of(const CalibrationFit& fit, std::size_t reading) {
  if (fit.readings[reading].kind != "anchor") return static_cast<double>(fit.readings[reading].record);
  std::size_t anchors = 0, records = 0;
  for (std::size_t i = 0; i <= reading; ++i)
    if (fit.readings[i].kind == "anchor")
      ++anchors;
    else
      records = fit.readings[i].record + 1;
  return static_cast<double>(records + anchors - 1);
}

struct Correlation {
  std::string pair;
  double value;
};

std::vector<Correlation> correlations_of(const CalibrationUncertainty& u) {
  std::vector<Correlation> all;
  for (std::size_t i = 0; i < u.correlation.size(); ++i)
    for (std::size_t j = i + 1; j < u.correlation.size(); ++j)
      if (u.correlation[i][j])
        all.push_back({u.parameters[i].symbol + ", " + u.parameters[j].symbol, *u.correlation[i][j]});
  std::stable_sort(all.begin(), all.end(), [](const Correlation& a, const Correlation& b) {
    return std::abs(a.value) > std::abs(b.value);
  });
  return all;
}

std::string paragraphs(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "\n\n") + sentence;
  return text;
}

void add_plot(CalibrationPage& page, ReportSection& section, const std::string& name,
              const ReportPlot& plot) {
  if (plot.plot.series.empty()) return;
  section.blocks.emplace_back(plot);
  page.plots.push_back({name, plot});
}

ReportTable table_of(const ResultTable& rows, const WideDesign& design, const std::string& caption) {
  return wide_table(rows, design.keys, design.columns, caption);
}

ReportSection result_section(const CalibrationMeasurements& measurements, const CalibrationFit& fit,
                             const ResultTable& rows) {
  ReportSection section{"What is determined", {}, {}};
  if (!measurements.comment.empty()) section.blocks.emplace_back(Paragraph{measurements.comment});
  section.blocks.emplace_back(Paragraph{paragraphs(calibration_sentences(fit))});
  section.blocks.emplace_back(
      table_of(rows, estimate_design(),
               "Parameters and what follows from them. What the readings do not "
               "determine to within a quarter of its own size (of 1 dpt for the vergence) has no estimate."));
  return section;
}

ReportSection conflict_section(const std::vector<DoubtedSource>& doubts) {
  ReportSection section{"What would reconcile the readings", {}, {}};
  section.blocks.emplace_back(Paragraph{paragraphs(doubt_sentences(doubts))});
  section.blocks.emplace_back(table_of(
      doubt_rows(doubts), doubt_design(doubts),
      "Plain least-squares fits without one source, or without two where that reconciles the rest; a "
      "source is all readings of a kind, an anchor, or a fixed value. χ² of “nothing” differs from "
      "that above where a robust loss was used there. A source that reconciles the rest is not "
      "thereby wrong: it is what to measure again."));
  return section;
}

std::vector<KeyFigure> key_figures_of(const CalibrationFit& fit) {
  std::vector<KeyFigure> figures;
  const bool sound = !contradicts(fit) || isolated_outliers(fit);
  const auto spread = [&](const CalibrationEstimate& e) {
    return sound ? fmt::format("± {}", format_number(*e.sd, 2))
                 : std::string("readings contradict each other");
  };
  for (const CalibrationEstimate& e : fit.uncertainty.derived)
    if (e.name == "fov_deg" && e.determined())
      figures.push_back({"field of view", format_number(e.value), e.unit, spread(e)});
  for (const CalibrationEstimate& e : fit.uncertainty.parameters)
    if ((e.name == "d_l_mm" || e.name == "f_mm") && e.sd.value_or(0) > 0)
      figures.push_back({e.symbol, format_number(e.value), e.unit, spread(e)});
  figures.push_back({"rank", std::to_string(fit.uncertainty.rank), "",
                     fmt::format("of {} unknowns", fit.uncertainty.unknowns)});
  figures.push_back(
      {"χ²", format_number(fit.chi2), "", fmt::format("{} degrees of freedom", fit.degrees_of_freedom)});
  return figures;
}

}  // namespace

ReportPlot residual_plot(const CalibrationFit& fit) {
  ReportPlot plot;
  plot.plot.x = {.title = "Number of the record in the file's “records”, then anchors"};
  plot.plot.y = {.title = "Predicted − measured", .unit = "standard deviations"};
  plot.plot.key = KeyPosition::kOutside;
  for (const auto& source : sources_in(fit)) {
    PlotSeries series{source.second.empty() ? source.first : source.first + " " + without_unit(source.second),
                      PlotSeries::Style::kPoints,
                      {}};
    for (std::size_t i = 0; i < fit.readings.size(); ++i) {
      const FittedReading& r = fit.readings[i];
      if (r.kind != source.first || (r.kind != "anchor" && r.what != source.second)) continue;
      series.points.push_back({.x = place_of(fit, i), .y = r.deviations, .marked = r.outlier});
    }
    plot.plot.series.push_back(std::move(series));
  }
  const double begin = -1, end = fit.readings.empty() ? 1 : place_of(fit, fit.readings.size() - 1) + 1;
  plot.plot.series.push_back({"± 2 deviations",
                              PlotSeries::Style::kLines,
                              {{begin, -2}, {end, -2}, {end, 2}, {begin, 2}, {begin, -2}}});
  plot.plot.marked_title = "outlier";
  plot.caption =
      "Residuals of readings and anchors in their own standard deviations; about one in twenty lies beyond ± "
      "2 if the model holds.";
  plot.alt = fmt::format("Points of {} residuals about zero.", fit.readings.size());
  return plot;
}

ReportPlot agreement_plot(const CalibrationFit& fit, const std::string& kind, const std::string& reading) {
  ReportPlot plot;
  PlotSeries points{kind, PlotSeries::Style::kPoints, {}};
  double low = 0, high = 0;
  for (const FittedReading& r : fit.readings) {
    if (r.kind != kind || r.what != reading) continue;
    if (points.points.empty()) low = high = r.predicted;
    low = std::min({low, r.predicted, r.measured});
    high = std::max({high, r.predicted, r.measured});
    points.points.push_back({.x = r.predicted,
                             .y = r.measured,
                             .y_low = r.measured - CalibrationEstimate::kNormal95 * r.sd,
                             .y_high = r.measured + CalibrationEstimate::kNormal95 * r.sd,
                             .marked = r.outlier});
  }
  if (points.points.empty()) return plot;
  const std::string what = without_unit(reading), unit = unit_in(reading);
  plot.plot.x = {.title = "Predicted " + what, .unit = unit};
  plot.plot.y = {.title = "Measured " + what, .unit = unit};
  plot.plot.series = {{"equal", PlotSeries::Style::kLines, {{low, low}, {high, high}}}, std::move(points)};
  plot.plot.key = KeyPosition::kTopLeft;
  plot.plot.marked_title = "outlier";
  plot.caption = fmt::format("Predicted against measured: {} {}, bars 95 %.", kind, what);
  plot.alt =
      fmt::format("Measured over predicted {} of {} readings beside the line of equality.", what, kind);
  return plot;
}

ReportPlot correlation_plot(const CalibrationFit& fit) {
  constexpr std::size_t kMost = 12;
  ReportPlot plot;
  std::vector<Correlation> all = correlations_of(fit.uncertainty);
  if (all.empty()) return plot;
  if (all.size() > kMost) all.resize(kMost);
  PlotSeries bars{"", PlotSeries::Style::kPoints, {}};
  for (const Correlation& c : all) {
    plot.plot.categories.push_back(c.pair);
    bars.points.push_back({.y = c.value});
  }
  plot.plot.series = {std::move(bars)};
  plot.plot.y = {.title = "Correlation", .minimum = -1, .maximum = 1};
  plot.plot.key = KeyPosition::kNone;
  plot.caption =
      "Strongest correlations of the errors of two parameters: near ± 1 one cannot be known better without "
      "the other.";
  plot.alt = fmt::format("Bars from {} with {:.2f} down.", all.front().pair, all.front().value);
  return plot;
}

ReportPlot direction_plot(const CalibrationFit& fit) {
  ReportPlot plot;
  const auto& singular = fit.uncertainty.singular_values;
  if (singular.empty() || !(singular.front() > 0)) return plot;
  PlotSeries known{"standard deviation", PlotSeries::Style::kLinesPoints, {}};
  for (std::size_t i = 0; i < singular.size(); ++i)
    if (static_cast<int>(i) < fit.uncertainty.rank)
      known.points.push_back({.x = static_cast<double>(i + 1), .y = 1 / singular[i]});
  const double end = static_cast<double>(singular.size()) + 0.5;
  plot.plot.series = {std::move(known), level(kKnownWithin, 0.5, end, "limit of “determined”")};
  plot.plot.x = {.title = "Direction, from best to least determined", .minimum = 0.5, .maximum = end};
  plot.plot.y = {.title = "Standard deviation, relative", .logarithmic = true};
  plot.plot.key = KeyPosition::kBottomRight;
  const int missing = fit.uncertainty.unknowns - fit.uncertainty.rank;
  plot.caption = fmt::format(
      "Standard deviations along the principal directions of the parameters (reciprocal singular values){}.",
      missing == 0 ? std::string()
                   : fmt::format("; {} more {} without any limit", missing, missing == 1 ? "is" : "are"));
  plot.alt = "Standard deviations rising from the best determined direction to the least.";
  return plot;
}

ReportPlot open_direction_plot(const CalibrationFit& fit) {
  ReportPlot plot;
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < kCalibrationParameters; ++i)
    if (std::any_of(fit.uncertainty.open.begin(), fit.uncertainty.open.end(),
                    [&](const OpenDirection& open) { return traits_of(i).positive && open.change[i] != 0; }))
      moved.push_back(i);
  if (moved.empty()) return plot;
  for (const std::size_t i : moved) plot.plot.categories.emplace_back(traits_of(i).symbol);
  for (std::size_t k = 0; k < fit.uncertainty.open.size(); ++k) {
    PlotSeries bars{fmt::format("direction {}", k + 1), PlotSeries::Style::kPoints, {}};
    for (const std::size_t i : moved) bars.points.push_back({.y = 100 * fit.uncertainty.open[k].change[i]});
    plot.plot.series.push_back(std::move(bars));
  }
  plot.plot.y = {.title = "Change together", .unit = "%"};
  plot.plot.key = KeyPosition::kOutside;
  plot.caption =
      "Directions that the readings leave open: changed together like this, the parameters give the same "
      "predictions.";
  plot.alt = "Bars of relative changes of each parameter along the open directions.";
  return plot;
}

CalibrationPage calibration_page(const std::string& title, const CalibrationMeasurements& measurements,
                                 const CalibrationFit& fit, const std::vector<DoubtedSource>& doubts,
                                 const Provenance& provenance) {
  CalibrationPage page;
  const ResultTable rows = calibration_rows(measurements, fit);
  page.report.title = title;
  page.report.subtitle = "Lengths and angles of a near-eye light-field display from measurement records.";
  page.report.key_figures = key_figures_of(fit);
  page.report.sections.push_back(result_section(measurements, fit, rows));
  if (!doubts.empty()) page.report.sections.push_back(conflict_section(doubts));
  ReportSection unknowns{"What hangs together", {}, {}};
  add_plot(page, unknowns, "open-directions", open_direction_plot(fit));
  add_plot(page, unknowns, "directions", direction_plot(fit));
  add_plot(page, unknowns, "correlations", correlation_plot(fit));
  page.report.sections.push_back(std::move(unknowns));
  ReportSection readings{"Readings", {}, {}};
  add_plot(page, readings, "residuals", residual_plot(fit));
  for (const auto& source : sources_in(fit))
    if (source.first != "anchor")
      add_plot(page, readings, "agreement-" + source.first + "-" + without_unit(source.second),
               agreement_plot(fit, source.first, source.second));
  readings.blocks.emplace_back(table_of(rows, reading_design(), "Readings and anchors against the fit"));
  page.report.sections.push_back(std::move(readings));
  page.report.provenance = provenance;
  return page;
}

}  // namespace plenolab
