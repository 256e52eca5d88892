#pragma once

#include <string>
#include <string_view>

#include "core/lightfield/light_field.h"
#include "core/lightfield/view_grid.h"

namespace plenolab {

/// Name of the description file in a light field folder.
inline constexpr const char* kDescriptionFile = "lightfield.json";

/// What the third geometric channel of the views holds.
enum class GeometryChannel {
  kDisparity_px,  ///< pixels per column spacing, ≥ 0
  kDepth_m,       ///< planar depth in metres
};

/// The contents of lightfield.json, version 1.
struct LightFieldDescription {
  ViewGrid grid;
  bool display_referred = false;
  RadianceUnit unit = RadianceUnit::kRelative;  ///< of scene-referred radiance
  std::string view_pattern;  ///< file name with {column} and {row}, e.g. "view_{row:02}_{column:02}.exr"
  std::string r = "R", g = "G", b = "B";  ///< channel names
  std::string geometry = "disparity";     ///< name of the geometry channel
  GeometryChannel geometry_kind = GeometryChannel::kDisparity_px;
};

/// Parses lightfield.json; `name` stands for the file in messages. Throws InputError with one sentence naming
/// file and key for anything missing, of a wrong type, unknown or out of range (at most 10 000 views, 65 536
/// pixels a side).
LightFieldDescription parse_description(std::string_view json, const std::string& name);

/// The text of lightfield.json for a description, ending in a newline.
std::string format_description(const LightFieldDescription& description);

/// File name of view (column, row): replaces {column} and {row}, each optionally with a width as in {row:02}
/// (zeros) or {row:2} (blanks). Throws InputError (naming `name`) for other braces, a missing placeholder,
/// absolute names and names that leave the folder.
std::string expand_view_pattern(const std::string& pattern, int column, int row, const std::string& name);

}  // namespace plenolab
