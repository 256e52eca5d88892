#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "core/image/image.h"

namespace plenolab {

/// Parses a Radiance picture (.hdr, .pic: FORMAT=32-bit_rle_rgbe) in memory; `name` stands for it in
/// messages. Flat, old and new run-length coding; orientations "-Y h +X w", "+Y h +X w", "-Y h -X w", "+Y h
/// -X w". EXPOSURE lines are divided out as the format demands. A mantissa m with exponent e stands for
/// m/256·2^(e−128), with e = 0 for black. Throws InputError for XYZE pictures, transposed orientations, and
/// damaged or truncated files.
SceneImage parse_radiance_hdr(std::span<const std::byte> bytes, const std::string& name);
SceneImage read_radiance_hdr(const std::filesystem::path& path);

/// Writes run-length coded RGBE, atomically. RGBE holds neither negative nor non-finite values nor more than
/// 1.7e38: throws InputError naming the first such pixel (repair the image first, or write .exr).
void write_radiance_hdr(const std::filesystem::path& path, const SceneImage& image);

}  // namespace plenolab
