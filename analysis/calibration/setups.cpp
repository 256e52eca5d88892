#include "analysis/calibration/setups.h"

#include <cmath>

#include "analysis/calibration/model.h"

namespace plenolab {

namespace {

using P = CalibrationParameter;
using Role = ParameterSetting::Role;

constexpr double kPixelPitchKnown_mm = 1e-5;
constexpr double kEdgeReading_mm = 0.2, kFocusReading_dpt = 0.2, kGridReading_px = 0.3,
                 kTargetReading_mm = 0.05, kSharpnessReading = 0.02;
constexpr double kCameraHeight_mm = 300;
constexpr double kImageDistance_mm = 965;

void set_free(CalibrationRig& rig, std::initializer_list<P> parameters) {
  for (const P p : parameters) rig.plan.parameters[index_of(p)].role = Role::kFree;
}

void anchor(ParameterSettings& settings, P parameter, double sd) {
  settings[index_of(parameter)].role = Role::kAnchored;
  settings[index_of(parameter)].sd = sd;
}

void add_edges(CalibrationRig& rig, double height_mm, bool vertical) {
  for (const CalibrationAxis axis : {CalibrationAxis::kX, CalibrationAxis::kY})
    for (const int side : {-1, 1})
      if (axis == CalibrationAxis::kX || vertical)
        rig.plan.records.emplace_back(EdgeRecord{axis, side, height_mm, 0, kEdgeReading_mm});
}

void add_focus(CalibrationRig& rig, int readings) {
  for (int i = 0; i < readings; ++i) rig.plan.records.emplace_back(FocusRecord{0, kFocusReading_dpt});
}

/// The corners, edges and middle of the 15 × 8 lenses.
void add_grid(CalibrationRig& rig) {
  for (const int row : {-3, 0, 3})
    for (const int column : {-7, 0, 7})
      rig.plan.records.emplace_back(GridRecord{column, row, 0, 0, kGridReading_px});
}

void add_targets(CalibrationRig& rig, std::initializer_list<double> angles_deg,
                 std::initializer_list<double> depths_mm) {
  for (const double angle : angles_deg)
    for (const double depth : depths_mm)
      rig.plan.records.emplace_back(
          TargetRecord{depth, angle, angle, kCameraHeight_mm, 0, kTargetReading_mm});
}

void add_sharpness(CalibrationRig& rig, double middle, double width) {
  for (int i = -4; i <= 4; ++i)
    rig.plan.records.emplace_back(
        SharpnessRecord{middle + 0.5 * i * width, kImageDistance_mm, 0, kSharpnessReading});
}

/// A display that is a little off everywhere: what calibration is for.
ParameterValues imperfect_display() {
  ParameterValues truth = nominal_values();
  truth[index_of(P::kLensPitch)] = 0.996;
  truth[index_of(P::kLensDistance)] = 3.05;
  truth[index_of(P::kFocalLength)] = 3.062;
  truth[index_of(P::kOffsetX)] = 0.03;
  truth[index_of(P::kOffsetY)] = -0.02;
  truth[index_of(P::kRotation)] = 0.4;
  truth[index_of(P::kPupilOffset)] = 2;
  truth[index_of(P::kSharpness)] = 0.9;
  truth[index_of(P::kSharpnessWidth)] = 0.012;
  return truth;
}

}  // namespace

CalibrationRig grid_rig() {
  CalibrationRig rig;
  rig.plan.comment = "Lens centres on the pixel grid under a microscope, as in figure B.1.";
  rig.truth[index_of(P::kLensPitch)] = 0.996;
  rig.truth[index_of(P::kOffsetX)] = 0.03;
  rig.truth[index_of(P::kOffsetY)] = -0.02;
  rig.truth[index_of(P::kRotation)] = 0.4;
  set_free(rig, {P::kLensPitch, P::kOffsetX, P::kOffsetY, P::kRotation});
  anchor(rig.plan.parameters, P::kPixelPitch, kPixelPitchKnown_mm);
  add_grid(rig);
  return rig;
}

CalibrationRig unanchored_rig() {
  CalibrationRig rig;
  rig.plan.comment =
      "Edges, focus and lens grid with all four lengths free: a scale is missing, so that no length is "
      "determined, only ratios.";
  set_free(rig, {P::kPixelPitch, P::kLensPitch, P::kLensDistance, P::kFocalLength});
  add_edges(rig, kCameraHeight_mm, true);
  add_focus(rig, 3);
  add_grid(rig);
  return rig;
}

CalibrationRig anchored_rig() {
  CalibrationRig rig = unanchored_rig();
  rig.plan.comment = "The same readings with the pixel pitch known to 0.01 µm: every length is determined.";
  anchor(rig.plan.parameters, P::kPixelPitch, kPixelPitchKnown_mm);
  return rig;
}

CalibrationRig full_rig() {
  CalibrationRig rig;
  rig.plan.comment = "Everything that appendices B, C and D measure, on a display that is a little off.";
  rig.truth = imperfect_display();
  set_free(rig, {P::kLensPitch, P::kLensDistance, P::kFocalLength, P::kOffsetX, P::kOffsetY, P::kRotation,
                 P::kPupilOffset, P::kSharpness, P::kSharpnessWidth});
  anchor(rig.plan.parameters, P::kPixelPitch, kPixelPitchKnown_mm);
  add_edges(rig, kCameraHeight_mm, true);
  add_edges(rig, kCameraHeight_mm / 3, true);
  add_targets(rig, {0, 6}, {200, 500, 2000});
  add_focus(rig, 3);
  add_grid(rig);
  add_sharpness(rig, 1.0, rig.truth[index_of(P::kSharpnessWidth)]);
  return rig;
}

CalibrationRig target_rig(double true_fov_deg) {
  CalibrationRig rig;
  rig.plan.comment =
      "A target straight ahead and an oblique one at several virtual depths, as in figure C.4.";
  const double subimage_mm = rig.plan.instrument.subimage_px * rig.truth[index_of(P::kPixelPitch)];
  const double d_l = subimage_mm / (2 * std::tan(radians(true_fov_deg) / 2));
  rig.truth[index_of(P::kLensDistance)] = d_l;
  set_free(rig, {P::kLensDistance, P::kOffsetX});
  add_targets(rig, {0, 6}, {120, 200, 350, 600, 1000, 2000, 6000});
  return rig;
}

CalibrationMeasurements thesis_measurements() {
  constexpr double kMeasuredFov_deg = 19.86, kFovReading_deg = 0.2;
  constexpr double kPixelsPerMm = 83 + 1.0 / 3, kPixelsPerMmWhenSharp = 80 + 1.0 / 3;
  CalibrationMeasurements m;
  m.comment =
      "Hansen & Klein 2016: 19.86 deg measured (appendix C, which prints only the angle), a spacer with "
      "which the panel is sharp (appendix A; the design puts its image at 965 mm), subimages "
      "that had to be scaled down from 83 1/3 to 80 1/3 px to be sharp (appendix D, section 3.2.3), nominal "
      "lengths (section 3.1). Deviations are ours.";
  m.records.emplace_back(FieldOfViewRecord{kMeasuredFov_deg, kFovReading_deg});
  m.records.emplace_back(FocusRecord{kDioptresPerMm / kImageDistance_mm, 0.5});
  m.records.emplace_back(SharpestScaleRecord{kImageDistance_mm, kPixelsPerMm / kPixelsPerMmWhenSharp, 0.005});
  m.parameters[index_of(P::kLensDistance)].role = Role::kFree;
  anchor(m.parameters, P::kPixelPitch, kPixelPitchKnown_mm);
  anchor(m.parameters, P::kLensPitch, 0.005);
  anchor(m.parameters, P::kFocalLength, 0.033);
  return m;
}

}  // namespace plenolab
