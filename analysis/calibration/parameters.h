#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace plenolab {

/// What a calibration may ask of a near-eye light-field display (Hansen & Klein 2016, section 3.1 and
/// appendices B to D).
enum class CalibrationParameter {
  kPixelPitch,      ///< p, distance between pixels of the panel
  kLensPitch,       ///< w_l, distance between lens centres
  kLensDistance,    ///< d_l, from the lenses to the panel
  kFocalLength,     ///< f of a lens
  kOffsetX,         ///< lens (0, 0) against the centre of subimage (0, 0), to the right
  kOffsetY,         ///< the same, downwards
  kRotation,        ///< lens grid against pixel grid, from x towards y
  kPupilOffset,     ///< what the measured height of the camera falls short of that of its entrance pupil
  kSharpness,       ///< largest apparent sharpness
  kSharpnessWidth,  ///< change of the screen scale that halves it
};

inline constexpr int kCalibrationParameters = 10;

/// One value for each parameter, by its index, in its unit.
using ParameterValues = std::array<double, kCalibrationParameters>;

constexpr std::size_t index_of(CalibrationParameter parameter) {
  return static_cast<std::size_t>(parameter);
}

/// How a parameter is called, and what it is.
struct ParameterTraits {
  const char* name;        ///< in files and results, with its unit: "d_l_mm"
  const char* symbol;      ///< in sentences: "d_l"
  const char* unit;        ///< "mm", "deg" or "1"
  const char* meaning;     ///< for people
  bool positive;           ///< must be > 0, and is told as a relative change
  double default_nominal;  ///< of a file that does not give it: the thesis' own figures
};

const ParameterTraits& traits_of(CalibrationParameter parameter);
const ParameterTraits& traits_of(std::size_t index);

/// The parameter with this name; nothing if there is none.
std::optional<CalibrationParameter> parameter_named(std::string_view name);

/// Nominal values of the thesis: p 12 µm, w_l 1 mm, f 3.3 mm, d_l from equation 3.1 with an eye relief of
/// 35 mm and the virtual image 1 m from the eye.
ParameterValues nominal_values();

/// The same distance by equation 3.1: f·z/(f + z) with z from the lenses to the virtual image.
double lens_distance_mm(double focal_length_mm, double image_distance_mm);

/// How a parameter takes part in a fit.
struct ParameterSetting {
  enum class Role {
    kFixed,     ///< stays at its nominal value, taken as exact
    kAnchored,  ///< fitted; its nominal value counts as one more reading, with its own standard deviation
    kFree,      ///< fitted; its nominal value is only where the search begins
  };
  double nominal = 0;
  Role role = Role::kFixed;
  double sd = 0;  ///< > 0 where anchored
};

/// "fixed", "anchored" or "free".
const char* name_of(ParameterSetting::Role role);

using ParameterSettings = std::array<ParameterSetting, kCalibrationParameters>;

/// Every parameter fixed at its nominal value.
ParameterSettings nominal_settings();

}  // namespace plenolab
