#include "core/lightfield/description.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/error.h"
#include "core/io/json_reader.h"

namespace plenolab {

namespace {

constexpr int kFormatVersion = 1;
constexpr const char* kFormatName = "plenolab-lightfield";
constexpr int kMaxViews = 10000;
constexpr int kMaxSide = 65536;

void read_radiance(const JsonReader& root, LightFieldDescription& description) {
  const std::string radiance = root.text("radiance");
  if (radiance != "cd/m2" && radiance != "relative" && radiance != "display")
    root.wrong("radiance",
               fmt::format("must be \"cd/m2\", \"relative\" or \"display\", not \"{}\"", radiance));
  description.display_referred = radiance == "display";
  description.unit = radiance == "cd/m2" ? RadianceUnit::kCdM2 : RadianceUnit::kRelative;
}

void read_grid(const JsonReader& root, ViewGrid& grid) {
  const JsonReader counts = root.object("grid"), spacing = root.object("spacing"),
                   image = root.object("image");
  counts.allow_only({"columns", "rows"});
  spacing.allow_only({"x", "y"});
  image.allow_only({"width", "height", "fov_h_deg"});
  grid.columns = counts.integer("columns", 1, kMaxViews);
  grid.rows = counts.integer("rows", 1, kMaxViews / grid.columns);
  grid.spacing_x_m = spacing.positive("x");
  grid.spacing_y_m = spacing.positive("y");
  grid.width = image.integer("width", 1, kMaxSide);
  grid.height = image.integer("height", 1, kMaxSide);
  grid.fov_h_deg = image.positive("fov_h_deg");
  if (grid.fov_h_deg >= 180)
    image.wrong("fov_h_deg", fmt::format("must be less than 180, not {}", grid.fov_h_deg));
}

void read_channels(const JsonReader& root, LightFieldDescription& description) {
  const JsonReader channels = root.object("channels");
  channels.allow_only({"r", "g", "b", "disparity", "depth"});
  description.r = channels.text("r");
  description.g = channels.text("g");
  description.b = channels.text("b");
  if (channels.has("disparity") == channels.has("depth"))
    channels.wrong("disparity", "or \"channels.depth\" must be given, and only one of them");
  description.geometry_kind =
      channels.has("depth") ? GeometryChannel::kDepth_m : GeometryChannel::kDisparity_px;
  description.geometry = channels.text(channels.has("depth") ? "depth" : "disparity");
}

struct Placeholder {
  bool is_row = false;
  int width = 0;
  bool zeros = false;
};

std::optional<Placeholder> parse_placeholder(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view key = text.substr(0, colon);
  if (key != "row" && key != "column") return std::nullopt;
  Placeholder placeholder;
  placeholder.is_row = key == "row";
  if (colon == std::string_view::npos) return placeholder;
  std::string_view format = text.substr(colon + 1);
  placeholder.zeros = format.starts_with('0');
  if (format.ends_with('d')) format.remove_suffix(1);
  if (placeholder.zeros) format.remove_prefix(1);
  if (format.size() != 1 || !(format[0] >= '1' && format[0] <= '9')) return std::nullopt;
  placeholder.width = format[0] - '0';
  return placeholder;
}

std::string insert(const Placeholder& p, int column, int row) {
  const int value = p.is_row ? row : column;
  return p.zeros ? fmt::format("{:0{}}", value, p.width) : fmt::format("{:{}}", value, p.width);
}

// A view must be a plain file of the folder or of one below it.
void check_inside(const std::string& file_name, const std::string& name) {
  const std::filesystem::path path(file_name);
  bool inside = path.is_relative() && path.has_filename() && file_name.find('\\') == std::string::npos;
  for (const auto& part : path) inside = inside && part != ".." && part != ".";
  if (!inside)
    throw InputError(
        fmt::format("{}: \"views\" must name files inside the folder, not \"{}\"", name, file_name));
}

}  // namespace

std::string expand_view_pattern(const std::string& pattern, int column, int row, const std::string& name) {
  std::string result;
  bool has_row = false, has_column = false;
  for (std::size_t at = 0; at < pattern.size();) {
    if (pattern[at] != '{' && pattern[at] != '}') {
      result += pattern[at++];
      continue;
    }
    const std::size_t end = pattern[at] == '{' ? pattern.find('}', at) : std::string::npos;
    const auto placeholder = end == std::string::npos
                                 ? std::nullopt
                                 : parse_placeholder(std::string_view(pattern).substr(at + 1, end - at - 1));
    if (!placeholder)
      throw InputError(
          fmt::format("{}: \"views\" may hold {{column}} and {{row}}, with a width as in {{row:02}}, but no "
                      "other braces: \"{}\"",
                      name, pattern));
    (placeholder->is_row ? has_row : has_column) = true;
    result += insert(*placeholder, column, row);
    at = end + 1;
  }
  if (!has_row || !has_column)
    throw InputError(
        fmt::format("{}: \"views\" must hold both {{column}} and {{row}}: \"{}\"", name, pattern));
  check_inside(result, name);
  return result;
}

LightFieldDescription parse_description(std::string_view json, const std::string& name) {
  constexpr int kMaxNesting = 8;
  const nlohmann::json document = parse_json(json, name, kMaxNesting);
  const JsonReader root(document, name, "");
  if (root.text("format") != kFormatName) root.wrong("format", fmt::format("must be \"{}\"", kFormatName));
  if (root.integer("version", 0, std::numeric_limits<int>::max()) != kFormatVersion)
    root.wrong("version", fmt::format("must be {}: this program knows no other", kFormatVersion));
  root.allow_only(
      {"format", "version", "grid", "spacing", "image", "radiance", "views", "channels", "comment"});
  LightFieldDescription description;
  read_grid(root, description.grid);
  read_radiance(root, description);
  description.view_pattern = root.text("views");
  expand_view_pattern(description.view_pattern, 0, 0, name);
  read_channels(root, description);
  return description;
}

std::string format_description(const LightFieldDescription& d) {
  using Ordered = nlohmann::ordered_json;
  Ordered json;
  json["format"] = kFormatName;
  json["version"] = kFormatVersion;
  json["grid"] = {{"columns", d.grid.columns}, {"rows", d.grid.rows}};
  json["spacing"] = {{"x", d.grid.spacing_x_m}, {"y", d.grid.spacing_y_m}};
  json["image"] = {{"width", d.grid.width}, {"height", d.grid.height}, {"fov_h_deg", d.grid.fov_h_deg}};
  json["radiance"] = d.display_referred ? "display" : d.unit == RadianceUnit::kCdM2 ? "cd/m2" : "relative";
  json["views"] = d.view_pattern;
  json["channels"] = {{"r", d.r}, {"g", d.g}, {"b", d.b}};
  json["channels"][d.geometry_kind == GeometryChannel::kDepth_m ? "depth" : "disparity"] = d.geometry;
  return json.dump(2) + "\n";
}

}  // namespace plenolab
