#pragma once

#include <string>

#include "core/lut/volumes.h"

namespace CLI {
class App;
}

namespace plenolab {

/// A camera as it is typed.
struct CameraOptions {
  std::string position = "0,0,0", forward = "0,1,0", up = "0,0,1";
  double fov_h_deg = 60;
};

/// Declares --camera, --forward, --up and --fov.
void add_camera_options(CLI::App& app, CameraOptions& options);

/// Directions may have any length, and `up` any angle but none to `forward`: its part at a right angle
/// counts. Throws UsageError that names the option, for anything but three finite numbers and directions that
/// are none.
DepthCamera camera_of(const CameraOptions& options);

}  // namespace plenolab
