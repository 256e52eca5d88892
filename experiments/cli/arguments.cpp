#include "experiments/cli/arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

bool parse_number(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

double distance(CameraPosition a, CameraPosition b) {
  return std::hypot(b.s - a.s, b.t - a.t);
}

CameraPosition between(CameraPosition a, CameraPosition b, double share) {
  return {a.s + (b.s - a.s) * share, a.t + (b.t - a.t) * share};
}

CameraPosition point_at(const std::vector<CameraPosition>& corners, double along) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length = distance(corners[i - 1], corners[i]);
    if (along <= length && length > 0) return between(corners[i - 1], corners[i], along / length);
    along -= length;
  }
  return corners.back();
}

}  // namespace

CameraPosition parse_position(const std::string& text, const std::string& option) {
  const auto parts = split(text, ',');
  CameraPosition position;
  if (parts.size() != 2 || !parse_number(parts[0], position.s) || !parse_number(parts[1], position.t))
    throw UsageError(fmt::format("{}: '{}' is not a position: give two numbers as in 1.5,0.5", option, text));
  return position;
}

std::vector<CameraPosition> parse_path(const std::string& text, int frames) {
  if (frames < 1) throw UsageError(fmt::format("--frames: a path needs at least one frame, not {}", frames));
  std::vector<CameraPosition> corners;
  for (const std::string& part : split(text, ':')) corners.push_back(parse_position(part, "--path"));
  if (corners.size() < 2)
    throw UsageError(fmt::format("--path: '{}' is not a path: give S0,T0:S1,T1, e.g. 0,1:4,1", text));
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += distance(corners[i - 1], corners[i]);
  std::vector<CameraPosition> positions;
  for (int i = 0; i < frames; ++i) {
    const bool last = i + 1 == frames && frames > 1;
    positions.push_back(last ? corners.back()
                             : point_at(corners, frames > 1 ? length * i / (frames - 1) : 0));
  }
  return positions;
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  for (std::string& part : split(text, ','))
    if (!part.empty()) parts.push_back(std::move(part));
  return parts;
}

}  // namespace plenolab
