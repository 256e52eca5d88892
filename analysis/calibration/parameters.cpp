#include "analysis/calibration/parameters.h"

namespace plenolab {

namespace {

constexpr double kFocalLength_mm = 3.3;
constexpr double kImageDistance_mm = 1000 - 35;  // from the eye, less the eye relief

constexpr std::array<ParameterTraits, kCalibrationParameters> kTraits{{
    {"p_mm", "p", "mm", "pixel pitch of the panel", true, 0.012},
    {"w_l_mm", "w_l", "mm", "pitch of the lenses", true, 1.0},
    {"d_l_mm", "d_l", "mm", "distance of the lenses from the panel", true,
     kFocalLength_mm* kImageDistance_mm / (kFocalLength_mm + kImageDistance_mm)},
    {"f_mm", "f", "mm", "focal length of the lenses", true, kFocalLength_mm},
    {"offset_x_mm", "offset x", "mm", "lens grid against pixel grid, to the right", false, 0},
    {"offset_y_mm", "offset y", "mm", "lens grid against pixel grid, downwards", false, 0},
    {"rotation_deg", "rotation", "deg", "lens grid against pixel grid", false, 0},
    {"pupil_offset_mm", "pupil", "mm", "entrance pupil of the camera above its measured height", false, 0},
    {"sharpness", "S_max", "1", "largest apparent sharpness", true, 1},
    {"sharpness_width", "S_width", "1", "change of the screen scale that halves the sharpness", true, 0.01},
}};

}  // namespace

const ParameterTraits& traits_of(CalibrationParameter parameter) {
  return kTraits[index_of(parameter)];
}

const ParameterTraits& traits_of(std::size_t index) {
  return kTraits[index];
}

std::optional<CalibrationParameter> parameter_named(std::string_view name) {
  for (std::size_t i = 0; i < kTraits.size(); ++i)
    if (name == kTraits[i].name) return static_cast<CalibrationParameter>(i);
  return std::nullopt;
}

ParameterValues nominal_values() {
  ParameterValues values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = kTraits[i].default_nominal;
  return values;
}

double lens_distance_mm(double focal_length_mm, double image_distance_mm) {
  return focal_length_mm * image_distance_mm / (focal_length_mm + image_distance_mm);
}

const char* name_of(ParameterSetting::Role role) {
  switch (role) {
    case ParameterSetting::Role::kFixed:
      return "fixed";
    case ParameterSetting::Role::kAnchored:
      return "anchored";
    case ParameterSetting::Role::kFree:
      break;
  }
  return "free";
}

ParameterSettings nominal_settings() {
  ParameterSettings settings;
  const ParameterValues nominal = nominal_values();
  for (std::size_t i = 0; i < settings.size(); ++i) settings[i].nominal = nominal[i];
  return settings;
}

}  // namespace plenolab
