#include "experiments/lut/camera.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

Point3 parse_point(const std::string& text, const char* option) {
  const std::vector<std::string> parts = split_list(text);
  Point3 point;
  bool valid = parts.size() == 3;
  for (std::size_t k = 0; valid && k < 3; ++k) {
    const char* const end = parts[k].data() + parts[k].size();
    const auto [stop, error] = std::from_chars(parts[k].data(), end, point[k]);
    valid = error == std::errc() && stop == end && std::isfinite(point[k]);
  }
  if (!valid) throw UsageError(fmt::format("{} needs three numbers X,Y,Z, not '{}'", option, text));
  return point;
}

double dot(const Point3& a, const Point3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point3 unit(const Point3& v, const std::string& otherwise) {
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0) || !std::isfinite(length)) throw UsageError(otherwise);
  return {v[0] / length, v[1] / length, v[2] / length};
}

}  // namespace

void add_camera_options(CLI::App& app, CameraOptions& options) {
  app.add_option("--camera", options.position, "Position of the camera as X,Y,Z in metres")
      ->capture_default_str();
  app.add_option("--forward", options.forward, "Where it looks, as X,Y,Z of any length")
      ->capture_default_str();
  app.add_option("--up", options.up, "What is up, as X,Y,Z; its part at a right angle to --forward counts")
      ->capture_default_str();
  app.add_option("--fov", options.fov_h_deg, "Full horizontal opening angle in degrees")
      ->capture_default_str()
      ->check(number_between(0.01, 179.99));
}

DepthCamera camera_of(const CameraOptions& options) {
  const auto direction = [](const std::string& text, const char* option) {
    return unit(parse_point(text, option),
                fmt::format("{} {} is no direction: it has no length", option, text));
  };
  DepthCamera camera{parse_point(options.position, "--camera"), direction(options.forward, "--forward"),
                     direction(options.up, "--up"), options.fov_h_deg};
  const double along = dot(camera.up, camera.forward);
  constexpr double kParallel = 1 - 1e-9;
  if (std::abs(along) > kParallel)
    throw UsageError(
        fmt::format("--up {} is parallel to --forward {}: give another --up", options.up, options.forward));
  for (std::size_t k = 0; k < 3; ++k) camera.up[k] -= along * camera.forward[k];
  camera.up = unit(camera.up, "--up has no part at a right angle to --forward");
  return camera;
}

}  // namespace plenolab
