#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/calibration/setups.h"
#include "experiments/calibration/calibration_page.h"
#include "experiments/calibration/calibration_results.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_angles_over_depth(Laboratory& laboratory);
ReproductionResult reproduce_confirmed_field_of_view(Laboratory& laboratory);

namespace {

constexpr double kPrintedNominal_deg = 17.28;
constexpr double kHalfLens_mm = 0.5;

/// Where the oblique targets of the rig appear on the lenses of a display with this field of view.
std::vector<PlotPoint> positions_over_depth(double display_fov_deg) {
  const CalibrationRig rig = target_rig(display_fov_deg);
  std::vector<PlotPoint> points;
  for (const CalibrationRecord& record : exact_measurements(rig).records)
    if (const auto& target = std::get<TargetRecord>(record); target.target_angle_deg != 0)
      points.push_back({target.virtual_depth_mm, target.position_mm});
  return points;
}

double drift_mm(const std::vector<PlotPoint>& points) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.y < b.y; });
  return high->y - low->y;
}

/// Whether the oblique target stays behind the middle lens at every depth, so that the check of figure C.4
/// passes.
bool passes(double display_fov_deg) {
  const auto points = positions_over_depth(display_fov_deg);
  return std::all_of(points.begin(), points.end(),
                     [](const PlotPoint& p) { return std::abs(p.y) <= kHalfLens_mm; });
}

/// Field of view at which passing ends, between one that passes and one that does not.
double edge_of_passing(double inside_deg, double outside_deg) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside_deg + outside_deg) / 2;
    (passes(middle) ? inside_deg : outside_deg) = middle;
  }
  return inside_deg;
}

/// Readings of both spheres over depth, beside the edges of the middle lens.
Plot reading_plot(const CalibrationMeasurements& measurements) {
  Plot plot;
  plot.series = {{"straight ahead", PlotSeries::Style::kPoints, {}},
                 {"oblique", PlotSeries::Style::kPoints, {}}};
  double near = 1e9, far = 0;
  for (const CalibrationRecord& record : measurements.records) {
    const auto& r = std::get<TargetRecord>(record);
    const double bar = CalibrationEstimate::kNormal95 * r.sd_mm;
    // Side by side, since both are read at the same depths.
    const double depth = r.virtual_depth_mm * (r.target_angle_deg == 0 ? 0.97 : 1.03);
    plot.series[r.target_angle_deg == 0 ? 0 : 1].points.push_back(
        {.x = depth, .y = r.position_mm, .y_low = r.position_mm - bar, .y_high = r.position_mm + bar});
    near = std::min(near, r.virtual_depth_mm);
    far = std::max(far, r.virtual_depth_mm);
  }
  near *= 0.9, far *= 1.1;
  plot.series.push_back({"edges of the lens",
                         PlotSeries::Style::kLines,
                         {{near, -kHalfLens_mm},
                          {far, -kHalfLens_mm},
                          {far, kHalfLens_mm},
                          {near, kHalfLens_mm},
                          {near, -kHalfLens_mm}}});
  plot.x = {.title = "Virtual depth of the targets", .unit = "mm", .logarithmic = true};
  plot.y = {.title = "Place where they appear", .unit = "mm", .minimum = -0.7, .maximum = 0.7};
  plot.key = KeyPosition::kOutside;
  return plot;
}

}  // namespace

ReproductionResult reproduce_angles_over_depth(Laboratory&) {
  ReproductionResult result;
  const double rendered = CalibrationInstrument{}.render_fov_deg;
  Plot plot;
  plot.x = {.title = "Virtual depth of the target", .unit = "mm", .logarithmic = true};
  plot.y = {.title = "Place where it appears on the lenses", .unit = "mm"};
  plot.key = KeyPosition::kOutside;
  for (const double fov : {kPrintedNominal_deg, rendered, 2 * rendered - kPrintedNominal_deg}) {
    plot.series.push_back(
        {fmt::format("display {:.2f}°", fov), PlotSeries::Style::kLinesPoints, positions_over_depth(fov)});
    for (const PlotPoint& p : plot.series.back().points)
      result.rows.add({"position_mm", p.y, "mm", {{"display_fov_deg", fov}, {"virtual_depth_mm", p.x}}});
  }
  const double narrow = drift_mm(plot.series[0].points), equal = drift_mm(plot.series[1].points);
  result.paper_shows =
      "Figure C.3: with the right field of view a target that is scaled with its depth keeps its angle, and "
      "a camera that looks along that angle sees it at every depth; otherwise it follows another line.";
  result.ours_shows = fmt::format(
      "A target at 6° from 120 mm to 6 m, rendered with {:.2f}°, moves over the lenses by {} mm on a display "
      "with that angle and by {} mm on one with {:.2f}°.",
      rendered, format_number(equal < 1e-9 ? 0 : equal, 2), format_number(narrow, 3), kPrintedNominal_deg);
  result.differs = narrow > 2 * kHalfLens_mm
                       ? "The thesis draws the lines; here they follow from the chief rays of all lenses. "
                         "The drift is more than a lens, so that the check can tell these angles apart."
                       : "The thesis draws the lines; here they follow from the chief rays of all lenses. "
                         "The drift is less than a lens, so that the check could miss it.";
  result.add_plot("place-over-depth", {plot,
                                       "Where a target rendered at 6° appears from a camera 300 mm above the "
                                       "lenses that looks along 6°, for displays of three fields of view",
                                       "Curves over depth; the one with equal angles is flat at zero."});
  return result;
}

ReproductionResult reproduce_confirmed_field_of_view(Laboratory& laboratory) {
  ReproductionResult result;
  const double rendered = CalibrationInstrument{}.render_fov_deg;
  const double low = edge_of_passing(rendered, 5), high = edge_of_passing(rendered, 60);
  const CalibrationRig rig = target_rig(rendered);
  const CalibrationMeasurements measurements = simulate_measurements(rig, laboratory.options().seed);
  const CalibrationFit fit = fit_calibration(measurements, {.seed = laboratory.options().seed});
  const CalibrationEstimate& fov = fit.uncertainty.derived.front();
  result.rows = calibration_rows(measurements, fit);
  result.rows.add({"passing_fov_low_deg", low, "deg", {}});
  result.rows.add({"passing_fov_high_deg", high, "deg", {}});
  result.paper_shows =
      "Figure C.4: a thin green sphere straight ahead and a red one at an angle stay in sight of the camera "
      "at every depth; this confirmed the measured field of view of 19.86°.";
  result.ours_shows = fmt::format(
      "Seen through the middle lens of ± {} mm, a display of any field of view from {:.2f}° to {:.2f}° "
      "passes. Reading off where the spheres appear (± {} mm, {} readings) gives {}° ± {}°, with {:.2f}° "
      "true.",
      kHalfLens_mm, low, high, format_number(deviation_of(rig.plan.records.front())), rig.plan.records.size(),
      format_number(fov.value), format_number(fov.sd.value_or(0), 2), rendered);
  result.differs = fmt::format(
      "As a yes or no the check excludes the calculated {:.2f}° {}; its width of {:.2f}° is what “confirmed” "
      "means. Measured, the same pictures are {:.0f} times sharper.",
      kPrintedNominal_deg, low > kPrintedNominal_deg ? "indeed" : "not at all", high - low,
      (high - low) / (4 * fov.sd.value_or(1)));
  const WideDesign design = estimate_design();
  result.add_table(
      wide_table(result.rows, design.keys, design.columns, "Fit to simulated positions of both spheres"));
  result.add_plot("readings-over-depth",
                  {reading_plot(measurements),
                   "Where both spheres are seen, simulated, with 95 % bars; the yes or no of figure C.4 only "
                   "asks whether they lie between the lines, the edges of the middle lens",
                   "Points about zero, far inside two lines at plus and minus half a millimetre."});
  result.add_plot("residuals", residual_plot(fit));
  return result;
}

}  // namespace plenolab
