#pragma once

#include <ceres/jet.h>

#include <optional>
#include <string>
#include <vector>

#include "analysis/calibration/model.h"

namespace plenolab {

/// A rotation of the lens grid by this much moves the outermost of 15 lenses by more than half a
/// subimage: whoever does not know the rotation better knows nothing of it.
inline constexpr double kUsefulRotation_deg = 5;

/// The coordinates in which a geometry is fitted: dimensionless, of order one, and smooth where lengths are
/// not.
///   p, w_l, d_l, sharpness, width   log(value/nominal): positive, and a common scale is one direction
///   f                               V·f_nominal with V = 1/d_l − 1/f: the image distance 1/V may diverge
///   offsets                         over the nominal lens pitch
///   rotation                        over kUsefulRotation_deg
///   pupil offset                    over the mean height of the camera
/// One unit is the size of the thing itself, or what is large for it, so that a deviation of 1 means that
/// nothing is known.
class CalibrationCoordinates {
 public:
  explicit CalibrationCoordinates(const CalibrationMeasurements& measurements);

  /// Coordinates of the nominal values.
  ParameterValues nominal() const;

  template <class T>
  DisplayGeometry<T> geometry(const T* x) const {
    using std::exp;
    using P = CalibrationParameter;
    const auto scaled = [&](P p) { return exp(x[index_of(p)]) * nominal_[index_of(p)]; };
    const auto shifted = [&](P p, double unit) { return x[index_of(p)] * unit; };
    DisplayGeometry<T> g;
    g.pixel_pitch = scaled(P::kPixelPitch);
    g.lens_pitch = scaled(P::kLensPitch);
    g.lens_distance = scaled(P::kLensDistance);
    // With f taken as exact the vergence follows from d_l alone.
    g.vergence_per_mm = focal_length_fixed_ ? 1.0 / g.lens_distance - 1.0 / focal_length_mm()
                                            : shifted(P::kFocalLength, 1 / focal_length_mm());
    g.offset_x = shifted(P::kOffsetX, lens_pitch_mm());
    g.offset_y = shifted(P::kOffsetY, lens_pitch_mm());
    g.rotation_rad = shifted(P::kRotation, radians(kUsefulRotation_deg));
    g.pupil_offset = shifted(P::kPupilOffset, camera_height_mm_);
    g.sharpness = scaled(P::kSharpness);
    g.sharpness_width = scaled(P::kSharpnessWidth);
    return g;
  }

  /// Size of a parameter in its own unit: what a change by one unit of its coordinate means.
  double unit_of(std::size_t parameter) const;

 private:
  double focal_length_mm() const { return nominal_[index_of(CalibrationParameter::kFocalLength)]; }
  double lens_pitch_mm() const { return nominal_[index_of(CalibrationParameter::kLensPitch)]; }

  ParameterValues nominal_{};
  bool focal_length_fixed_ = false;
  double camera_height_mm_;
};

/// One whitened residual, (prediction − reading)/deviation: of a reading, or of an anchor.
struct CalibrationResidual {
  std::size_t record = 0;     ///< of a reading
  std::size_t component = 0;  ///< of its readings
  std::optional<CalibrationParameter> anchor;
};

/// All residuals of the measurements: readings in the order of the file, then anchors.
std::vector<CalibrationResidual> residuals_of(const CalibrationMeasurements& measurements);

/// What the model says in place of the reading.
template <class T>
T prediction_of(const CalibrationResidual& residual, const CalibrationMeasurements& measurements,
                const DisplayGeometry<T>& geometry) {
  if (residual.anchor) return parameter_value(geometry, *residual.anchor);
  return predict(measurements.records[residual.record], geometry,
                 measurements.instrument)[residual.component];
}

/// What was read, and its standard deviation.
double reading_of(const CalibrationResidual& residual, const CalibrationMeasurements& measurements);
double deviation_of(const CalibrationResidual& residual, const CalibrationMeasurements& measurements);

/// What the reading is called in files; of an anchor: the parameter.
std::string reading_name(const CalibrationResidual& residual, const CalibrationMeasurements& measurements);

/// Number with its derivatives by all coordinates.
using CalibrationJet = ceres::Jet<double, kCalibrationParameters>;

/// The geometry at `x` with derivatives by the coordinates.
DisplayGeometry<CalibrationJet> geometry_with_derivatives(const CalibrationCoordinates& coordinates,
                                                          const ParameterValues& x);

}  // namespace plenolab
