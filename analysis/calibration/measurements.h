#pragma once

#include <string>
#include <variant>
#include <vector>

#include "analysis/calibration/parameters.h"

namespace plenolab {

/// Records of one measurement each. Standard deviations are those of the reading, > 0. Axes: x to the right,
/// y down, both along the pixel grid; heights are measured from the lenses towards the camera.

enum class CalibrationAxis { kX, kY };

/// Figures C.1 and C.2: a camera looks straight down at one lens; moved sideways it sees the edge of the
/// subimage cross the centre of the lens.
struct EdgeRecord {
  CalibrationAxis axis = CalibrationAxis::kX;
  int side = 1;  ///< +1: camera moved towards positive coordinates, −1: towards negative ones
  double camera_height_mm = 0;
  double displacement_mm = 0;  ///< how far it was moved, ≥ 0 for a working display
  double sd_mm = 0;
};

/// A field of view of one subimage where only the angle was noted down, as in the thesis.
struct FieldOfViewRecord {
  double fov_deg = 0, sd_deg = 0;
};

/// Figures C.3 and C.4: a target at a virtual depth is seen by a camera that looks at the middle of the array
/// from an angle. Where its line of sight to the target crosses the lenses does not depend on the virtual
/// depth if the fields of view of the display and of the virtual cameras agree.
struct TargetRecord {
  double virtual_depth_mm = 0;  ///< from the virtual cameras
  double target_angle_deg = 0;  ///< of the target from the middle virtual camera, to the right
  double camera_angle_deg = 0;  ///< of the line of sight, the same sign for a target that is straight ahead
  double camera_height_mm = 0;
  double position_mm = 0;  ///< where the target appears, along x from the middle lens
  double sd_mm = 0;
};

/// The vergence at which pixels are seen sharp: 1/d_l − 1/f, the reciprocal distance of the virtual image of
/// the panel from the lenses. 0 at infinity, negative beyond it (d_l > f).
struct FocusRecord {
  double vergence_dpt = 0, sd_dpt = 0;
};

/// Figure B.1: the centre of a lens on the grid of pixels under a microscope, counted from the centre of
/// subimage (0, 0).
struct GridRecord {
  int column = 0, row = 0;
  double x_px = 0, y_px = 0, sd_px = 0;
};

/// Figure D.1: apparent sharpness with the screen taken to be `scale` times its real size, so that subimages
/// are that much smaller.
struct SharpnessRecord {
  double scale = 1;
  double virtual_depth_mm = 0;  ///< of the target
  double sharpness = 0, sd = 0;
};

/// The screen scale at which the image was sharpest where only that was noted down, as in the thesis.
struct SharpestScaleRecord {
  double virtual_depth_mm = 0;  ///< of the target
  double scale = 1, sd = 0;
};

using CalibrationRecord = std::variant<EdgeRecord, FieldOfViewRecord, TargetRecord, FocusRecord, GridRecord,
                                       SharpnessRecord, SharpestScaleRecord>;

/// "edge", "field-of-view", "target", "focus", "grid", "sharpness" or "sharpest-scale".
const char* kind_of(const CalibrationRecord& record);

/// What the renderer was told, known exactly.
struct CalibrationInstrument {
  double subimage_px = 1 / 0.012;  ///< width and pitch of a subimage at screen scale 1
  double camera_spacing_mm = 1;    ///< between virtual cameras
  double render_fov_deg = 19.86;   ///< of a virtual camera
};

/// Everything a fit starts from.
struct CalibrationMeasurements {
  std::string comment;
  CalibrationInstrument instrument;
  ParameterSettings parameters = nominal_settings();
  std::vector<CalibrationRecord> records;

  /// Throws InputError in one sentence that begins with `name` (a file) and says which value is out of its
  /// range: heights, depths, deviations and positive parameters > 0 and finite, angles within ±80°, at least
  /// one record and one parameter that is not fixed, a target of sharpness beyond the depth at which
  /// neighbouring virtual cameras see it a subimage apart.
  void validate(const std::string& name) const;
};

/// Number of readings in a record: 2 for a grid point, else 1.
int readings_in(const CalibrationRecord& record);

}  // namespace plenolab
