#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "core/image/image.h"
#include "core/lightfield/light_field.h"

namespace CLI {
class App;
}

namespace plenolab {

/// A light field of either meaning, as found on disk.
using AnyLightField = std::variant<LightField, DisplayLightField>;

/// Opens a light field folder or an HCI benchmark folder with at most `memory_mib` ≥ 1 MiB of views in
/// memory. Throws InputError if the folder is neither.
AnyLightField open_any_light_field(const std::filesystem::path& folder, int memory_mib = 2048);

/// The same, for commands that need radiance. Throws InputError if the light field is display-referred.
LightField open_radiance(const std::filesystem::path& folder, int memory_mib = 2048);

const ViewGrid& grid_of(const AnyLightField& light_field);

/// Declares --memory for open_any_light_field.
void add_memory_option(CLI::App& app, int& memory_mib);

/// Throws UsageError that names the option and the grid unless the position lies on it.
void require_on_grid(CameraPosition position, const ViewGrid& grid, const std::string& option);

/// An image of either meaning; the extension decides (.png = display-referred).
using AnyImage = std::variant<SceneImage, DisplayImage>;
AnyImage read_any_image(const std::filesystem::path& path);

/// Image files of a folder (frames of a video) that are not hidden, sorted by name. Throws InputError if
/// there are none.
std::vector<std::filesystem::path> image_files(const std::filesystem::path& folder);

/// Throws UsageError unless the file's extension is `extension` (with its dot), which is what will be
/// written.
void require_extension(const std::filesystem::path& path, const std::string& extension);

/// Whether the extension is .exr, in upper or lower case.
bool is_exr_file(const std::filesystem::path& path);

/// Whether the extension is that of a display-referred image.
bool is_display_file(const std::filesystem::path& path);

}  // namespace plenolab
