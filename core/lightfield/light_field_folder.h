#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/io/exr.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// What the numbers of a light field on disk mean.
enum class RadianceKind { kSceneReferred, kDisplayReferred };

/// Whether `folder` holds a lightfield.json.
bool is_light_field_folder(const std::filesystem::path& folder);

/// Kind of the light field in `folder`: decides which of the two open functions to call. Throws InputError if
/// its lightfield.json is missing or wrong.
RadianceKind light_field_kind(const std::filesystem::path& folder);

struct OpenLightFieldOptions {
  std::size_t memory_bound_bytes = LightField::kDefaultMemoryBound;  ///< for the views kept in memory
};

/// Opens a light field folder (design: lightfield.json and one EXR a view). Every view's header is checked at
/// once (existence, size, channels), pixels are read when first used. Depth becomes disparity by
/// ViewGrid::disparity_px; depth ≥ 1e9 m or +Inf means infinitely far (renderers write 1e10), depth ≤ 0 or
/// NaN is an error. Radiance is kept as it is stored, NaN, Inf and negative values included. Throws
/// InputError naming file and key for a wrong lightfield.json, naming the file for a missing, damaged or
/// unfitting view, and, when a view is loaded, for disparity that is negative, infinite or NaN. A
/// display-referred folder is an error here.
LightField open_light_field(const std::filesystem::path& folder, const OpenLightFieldOptions& options = {});

/// The same for tone-mapped light fields ("radiance": "display").
DisplayLightField open_display_light_field(const std::filesystem::path& folder,
                                           const OpenLightFieldOptions& options = {});

struct WriteLightFieldOptions {
  ExrPixelType colour_type = ExrPixelType::kHalf;  ///< kHalf or kFloat; disparity is always float
  ExrCompression compression = ExrCompression::kZip;
};

/// Writes a light field as a folder that appears whole or not at all: all views, then lightfield.json, in a
/// temporary folder beside it, which is renamed at the end. Throws InputError if `folder` exists and is not
/// an empty folder, or if radiance does not fit half (see write_exr).
void write_light_field(const std::filesystem::path& folder, const LightField& light_field,
                       const WriteLightFieldOptions& options = {}, const Progress& progress = {});
void write_light_field(const std::filesystem::path& folder, const DisplayLightField& light_field,
                       const WriteLightFieldOptions& options = {}, const Progress& progress = {});

}  // namespace plenolab
