#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "analysis/calibration/measurements.h"
#include "analysis/calibration/simulate.h"

namespace plenolab {

/// Measurement files: JSON, format "plenolab-calibration", version 1 (analysis/calibration/README.md shows
/// one).
///   instrument  {subimage_px, camera_spacing_mm, render_fov_deg}
///   parameters  {NAME: {nominal, "fixed": true | "sd": number | nothing more = free}}; what is not given is
///               fixed at the thesis' figure (parameters.h)
///   records     [{kind, …}], fields as in measurements.h; axis "x" or "y", side "positive" or "negative"
///   comment     optional
/// `name` is what messages call the file. Throws InputError in one sentence for anything else, unknown keys
/// included.
CalibrationMeasurements parse_measurements(std::string_view json, const std::string& name);
std::string format_measurements(const CalibrationMeasurements& measurements);
CalibrationMeasurements read_measurements(const std::filesystem::path& file);

/// Rigs: JSON, format "plenolab-calibration-rig", version 1: as above but without readings, and with
///   truth       {NAME: number}; what is not given is at its nominal value
///   outliers    {share, deviations}; optional: this share of the readings is off by so many deviations
CalibrationRig parse_rig(std::string_view json, const std::string& name);
std::string format_rig(const CalibrationRig& rig);
CalibrationRig read_rig(const std::filesystem::path& file);

}  // namespace plenolab
