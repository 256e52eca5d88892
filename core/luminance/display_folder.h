#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/luminance/projector_display.h"
#include "core/luminance/ray_images.h"

namespace plenolab {

/// A projector display with its images on disk: a folder with `display.json` and one image in cd/m² a
/// projector; the attribute whiteLuminance of an .exr, if it has one, says how many cd/m² its value 1 is:
/// ```
/// {
///   "format": "plenolab-display", "version": 1,
///   "screen": {"width_m": 0.645, "height_m": 0.36},
///   "observers": {"distance_m": 2, "half_range_m": 5},
///   "projectors": {"distance_m": 0.5, "layout": "line"},
///   "images": ["projector-000.exr", "projector-001.exr"]
/// }
/// ```
/// `layout` is "line" or "arc" (projector_display.h); images stand from the leftmost projector as observers
/// see it to the rightmost, all of one size (.exr .hdr .pfm).
struct DisplayDescription {
  ProjectorDisplayOptions display;  ///< but for the size of the images
  std::vector<std::string> images;  ///< file names inside the folder
};
/// Parses display.json; `name` stands for the file in messages. Throws InputError with one sentence naming
/// file and key for anything missing, of a wrong type, unknown or out of range.
DisplayDescription parse_display_description(std::string_view json, const std::string& name);
/// The text of display.json, ending in a newline.
std::string format_display_description(const DisplayDescription& description);

/// A display with the images of its folder.
struct DisplayFolder {
  ProjectorDisplayOptions display;
  SceneRays rays;
};

/// Whether the folder holds a display.json.
bool is_display_folder(const std::filesystem::path& folder);
/// Rays in cd/m²: values times `cd_m2_per_unit` if it is given, else times what each .exr says. Throws
/// InputError naming the file and what is wrong with it.
DisplayFolder read_display_folder(const std::filesystem::path& folder,
                                  std::optional<double> cd_m2_per_unit = std::nullopt);
/// Writes into a folder that exists or can be made; display.json comes last.
void write_display_folder(const std::filesystem::path& folder, const ProjectorDisplay& display,
                          const SceneRays& rays);

}  // namespace plenolab
