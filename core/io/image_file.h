#pragma once

#include <filesystem>
#include <optional>

#include "core/image/image.h"

namespace plenolab {

/// Reads linear radiance by the file's extension: .exr, .hdr (.pic), .pfm. Values are kept as they are: see
/// core/image/repair.h for NaN, Inf and negative ones. Throws InputError for other extensions (a .png is
/// display-referred) and for damaged files.
SceneImage read_scene_image(const std::filesystem::path& path);

/// Reads encoded display values in [0, 1] from an 8- or 16-bit .png, grey or colour; alpha is dropped.
DisplayImage read_display_image(const std::filesystem::path& path);

/// Writes linear radiance by the extension: .exr (32-bit float), .hdr, .pfm. Atomically; missing folders are
/// made. `cd_m2_per_unit`, if known, becomes the attribute whiteLuminance of an .exr; the others have none.
void write_scene_image(const std::filesystem::path& path, const SceneImage& image,
                       std::optional<double> cd_m2_per_unit = std::nullopt);

/// Bits per channel of a written PNG.
enum class PngDepth { k8Bit, k16Bit };

/// Writes a .png, rounding to the nearest code value. Throws InputError for other extensions and for a value
/// outside [0, 1] or NaN, naming the pixel.
void write_display_image(const std::filesystem::path& path, const DisplayImage& image,
                         PngDepth depth = PngDepth::k8Bit);

}  // namespace plenolab
