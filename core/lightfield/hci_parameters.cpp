#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/lightfield/hci.h"

namespace plenolab {

namespace {

using Values = std::map<std::string, std::string, std::less<>>;  // "section.key" to value

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

Values parse_ini(std::string_view text) {
  Values values;
  std::string section;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line[0] == '#' || line[0] == ';') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = trimmed(line.substr(1, line.size() - 2));
      continue;
    }
    const std::size_t equals = line.find_first_of("=:");
    if (equals == std::string_view::npos) continue;
    values[section + "." + std::string(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
  }
  return values;
}

const std::string& value_of(const Values& values, const std::string& key, const std::string& file) {
  const auto found = values.find(key);
  if (found == values.end())
    throw InputError(fmt::format("{} has no {} in section [{}]", file, key.substr(key.find('.') + 1),
                                 key.substr(0, key.find('.'))));
  return found->second;
}

template <class Number>
Number number_of(const Values& values, const std::string& key, const std::string& file) {
  const std::string& text = value_of(values, key, file);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(fmt::format("{}: {} is not a number of the right kind", file, key));
  return number;
}

void check_positive(double value, const char* key) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("{} must be positive, not {}", key, value));
}

void check_count(int value, int largest, const char* key) {
  if (value < 1 || value > largest)
    throw InputError(fmt::format("{} must lie in [1, {}], not {}", key, largest, value));
}

}  // namespace

double HciParameters::focal_length_px() const {
  return focal_length_mm * std::max(width, height) / sensor_size_mm;
}

double HciParameters::focus_disparity_px() const {
  return std::isinf(focus_distance_m) ? 0.0 : baseline_mm * 1e-3 * focal_length_px() / focus_distance_m;
}

void HciParameters::validate() const {
  constexpr int kMaxSide = 16384, kMaxCameras = 100;
  check_count(width, kMaxSide, "image_resolution_x_px");
  check_count(height, kMaxSide, "image_resolution_y_px");
  check_count(columns, kMaxCameras, "num_cams_x");
  check_count(rows, kMaxCameras, "num_cams_y");
  check_positive(focal_length_mm, "focal_length_mm");
  check_positive(sensor_size_mm, "sensor_size_mm");
  check_positive(baseline_mm, "baseline_mm");
  if (!(focus_distance_m > 0))
    throw InputError(fmt::format("focus_distance_m must be positive, not {}", focus_distance_m));
  // Extreme ratios of these lengths overflow although each of them is finite.
  if (!std::isfinite(focal_length_px()) || !(focal_length_px() > 0) || !std::isfinite(focus_disparity_px()))
    throw InputError(
        "focal_length_mm, sensor_size_mm, baseline_mm and focus_distance_m are not of one camera");
}

HciParameters parse_hci_parameters(std::string_view text, const std::string& name) {
  const Values values = parse_ini(text);
  HciParameters p;
  p.width = number_of<int>(values, "intrinsics.image_resolution_x_px", name);
  p.height = number_of<int>(values, "intrinsics.image_resolution_y_px", name);
  p.focal_length_mm = number_of<double>(values, "intrinsics.focal_length_mm", name);
  p.sensor_size_mm = number_of<double>(values, "intrinsics.sensor_size_mm", name);
  p.columns = number_of<int>(values, "extrinsics.num_cams_x", name);
  p.rows = number_of<int>(values, "extrinsics.num_cams_y", name);
  p.baseline_mm = number_of<double>(values, "extrinsics.baseline_mm", name);
  p.focus_distance_m = number_of<double>(values, "extrinsics.focus_distance_m", name);
  if (const auto scene = values.find("meta.scene"); scene != values.end()) p.scene = scene->second;
  try {
    p.validate();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  return p;
}

}  // namespace plenolab
