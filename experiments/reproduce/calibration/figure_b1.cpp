#include <fmt/format.h>

#include <cmath>

#include "analysis/calibration/setups.h"
#include "experiments/calibration/calibration_page.h"
#include "experiments/calibration/calibration_results.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_lens_grid(Laboratory& laboratory);

namespace {

constexpr double kColumnsToEdge = 7, kRowsToEdge = 3.5;  // of 15 × 8 lenses, from the middle

/// How far a rotation moves the subimage of the corner lens away from that lens, and how far it moves the
/// corner of a subimage that was put in its place.
struct Misplacement {
  double corner_lens_px, inside_subimage_px;
};

Misplacement misplacement_at(double rotation_deg, const ParameterValues& v) {
  const double turn = 2 * std::sin(radians(std::abs(rotation_deg)) / 2);
  const double lens_px =
      v[index_of(CalibrationParameter::kLensPitch)] / v[index_of(CalibrationParameter::kPixelPitch)];
  return {turn * lens_px * std::hypot(kColumnsToEdge, kRowsToEdge), turn * lens_px * std::sqrt(0.5)};
}

Plot misplacement_plot(const ParameterValues& v) {
  Plot plot;
  PlotSeries corner{"corner lens, subimages not moved", PlotSeries::Style::kLines, {}};
  PlotSeries inside{"corner of a subimage that was moved", PlotSeries::Style::kLines, {}};
  for (double rotation_deg = 0; rotation_deg <= 3.001; rotation_deg += 0.1) {
    const Misplacement m = misplacement_at(rotation_deg, v);
    corner.points.push_back({rotation_deg, m.corner_lens_px});
    inside.points.push_back({rotation_deg, m.inside_subimage_px});
  }
  plot.series = {std::move(corner), std::move(inside)};
  plot.x = {.title = "Rotation of the lens grid", .unit = "deg"};
  plot.y = {.title = "Misplacement", .unit = "px"};
  plot.key = KeyPosition::kTopLeft;
  return plot;
}

}  // namespace

ReproductionResult reproduce_lens_grid(Laboratory& laboratory) {
  ReproductionResult result;
  const CalibrationRig rig = grid_rig();
  const CalibrationMeasurements measurements = simulate_measurements(rig, laboratory.options().seed);
  const CalibrationFit fit = fit_calibration(measurements, {.seed = laboratory.options().seed});
  result.rows = calibration_rows(measurements, fit);
  const auto parameter = [&](CalibrationParameter p) { return fit.uncertainty.parameters[index_of(p)]; };
  const CalibrationEstimate rotation = parameter(CalibrationParameter::kRotation),
                            x = parameter(CalibrationParameter::kOffsetX);
  const Misplacement m = misplacement_at(rig.truth[index_of(CalibrationParameter::kRotation)], rig.truth);
  const Misplacement left = misplacement_at(rotation.sd.value_or(0), rig.truth);
  result.paper_shows =
      "Figure B.1: lenses are aligned with subimages by eye, under a microscope with a grid laid over the "
      "picture; a rotation of several degrees looks distorted, and rotation, unlike position, could not be "
      "corrected in the shader.";
  result.ours_shows = fmt::format(
      "Nine lens centres read to {} px on the pixel grid give the rotation as {}° ± {}° (true: {}°) and the "
      "offset as {} mm ± {} mm; lens pitch {} px ± {} px. The rotation of {}° displaces the corner lens by "
      "{} px, what is left after the fit by {} px.",
      format_number(deviation_of(rig.plan.records.front())), format_number(rotation.value),
      format_number(rotation.sd.value_or(0), 2),
      format_number(rig.truth[index_of(CalibrationParameter::kRotation)]), format_number(x.value),
      format_number(x.sd.value_or(0), 2), format_number(fit.uncertainty.derived[1].value),
      format_number(fit.uncertainty.derived[1].sd.value_or(0), 2),
      format_number(rig.truth[index_of(CalibrationParameter::kRotation)]), format_number(m.corner_lens_px, 3),
      format_number(left.corner_lens_px, 2));
  result.differs = fmt::format(
      "A fit replaces the eye, and its readings are simulated. It also says what a shader can do: once every "
      "subimage is put under its rotated lens, a rotation is left only inside subimages, {:.0f} times less "
      "at their corners than at the corner lens.",
      m.corner_lens_px / m.inside_subimage_px);
  const WideDesign design = estimate_design();
  result.add_table(wide_table(result.rows, design.keys, design.columns, "Lens grid against pixel grid"));
  result.add_plot(
      "misplacement",
      {misplacement_plot(rig.truth),
       "What a rotated lens grid displaces, as it is and after subimages were moved under their lenses",
       "Two straight lines; the one of the corner lens is many times steeper."});
  result.add_plot("residuals", residual_plot(fit));
  return result;
}

}  // namespace plenolab
