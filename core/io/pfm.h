#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/image/image.h"

namespace plenolab {

/// What a PFM file holds: "PF" colour or "Pf" a single plane (then r = g = b in `colour` is not filled and
/// `grey` is). Rows are stored bottom-up in the file and top-down here; both byte orders are read; the
/// scale's magnitude is not applied (as every benchmark's reader does it).
struct PfmImage {
  bool is_colour = false;
  SceneImage colour;  ///< filled if is_colour
  Plane<float> grey;  ///< filled if not
};

/// Parses a PFM file in memory; `name` stands for it in messages. Throws InputError if it is not one, or if
/// its length differs from what the header announces.
PfmImage parse_pfm(std::span<const std::byte> bytes, const std::string& name);

/// A single-plane PFM ("Pf"). Throws InputError for a colour one.
Plane<float> read_pfm_plane(const std::filesystem::path& path);
/// A PFM as an image, grey copied to all three channels.
SceneImage read_pfm_image(const std::filesystem::path& path);

/// Writes "Pf" / "PF", little endian, bottom-up, atomically.
void write_pfm(const std::filesystem::path& path, const Plane<float>& plane);
void write_pfm(const std::filesystem::path& path, const SceneImage& image);

}  // namespace plenolab
