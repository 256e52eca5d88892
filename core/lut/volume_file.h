#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/lut/volumes.h"

namespace plenolab {

/// Post-processing volumes and the tables they grade with, as a JSON file:
/// {
///   "format": "plenolab-volumes", "version": 1,
///   "background": "neutral.cube",
///   "volumes": [{"name": "hall", "min": [-2, 0, -2], "max": [2, 8, 2],
///                "blend_radius_m": 1, "weight": 1, "lut": "hall.cube"}]
/// }
/// World coordinates in metres; no two volumes have one name; tables are .cube files or .png strips, relative
/// to the file's folder. Without "background" it is the identity (over the first table's domain);
/// blend_radius_m and weight may be left out (0 and 1).
struct VolumeScene {
  std::vector<Volume> volumes;
  std::vector<std::string> tables;  ///< one for each volume, as written
  std::string background;           ///< empty: the identity
};

/// Throws InputError in one sentence with file and key for anything that is not as above; unknown keys too.
VolumeScene parse_volumes(std::string_view json, const std::string& name);

/// The file's text, which parse_volumes reads back. Throws InputError for invalid volumes.
std::string volumes_text(const VolumeScene& scene);

/// Volumes with their tables read.
struct LoadedVolumes {
  std::vector<Volume> volumes;
  std::vector<Lut> tables;
  Lut background;
  std::vector<std::filesystem::path> files;  ///< of the tables that were read
};
LoadedVolumes read_volumes(const std::filesystem::path& path);

}  // namespace plenolab
