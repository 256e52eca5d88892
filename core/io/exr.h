#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// How a channel is stored; read and handed out as float in every case.
enum class ExrPixelType { kHalf, kFloat, kUint };

/// One channel of an OpenEXR part, by the name the file gives it, e.g. "R" or "ViewLayer.Depth.Z".
struct ExrChannelInfo {
  std::string name;
  ExrPixelType type = ExrPixelType::kHalf;
};

/// What the header of one part says. `width` and `height` are those of the data window.
struct ExrPartInfo {
  std::string name;  ///< empty in single-part files
  int width = 0, height = 0;
  bool deep = false;
  std::vector<ExrChannelInfo> channels;  ///< sorted by name
  std::map<std::string, std::string> string_attributes;
  std::map<std::string, float> float_attributes;
  bool has_channel(const std::string& channel) const;
};

/// Bounds that a file must keep before anything in proportion to its claims is allocated.
struct ExrLimits {
  std::int64_t max_pixels = std::int64_t{1} << 28;        ///< of the data window
  std::uint64_t max_file_bytes = std::uint64_t{4} << 30;  ///< of the file itself
  /// Throws InputError for values that are not positive.
  void validate() const;
};

/// Headers of all parts of a file, without reading pixels. `name` stands for the file in messages. Throws
/// InputError if the bytes are not OpenEXR, are damaged, or break the limits.
std::vector<ExrPartInfo> parse_exr_header(std::span<const std::byte> bytes, const std::string& name,
                                          const ExrLimits& limits = {});
std::vector<ExrPartInfo> read_exr_header(const std::filesystem::path& path, const ExrLimits& limits = {});

/// The named channels as float planes of the data window's size, in the order asked for, from the first part
/// that holds all of them. Values are kept as they are, NaN and Inf included. Scan lines, tiles (full
/// resolution), any data window and multipart files are read. Throws InputError for a missing channel
/// (listing those there are), deep or subsampled data, damaged or incomplete files, and broken limits.
std::vector<Plane<float>> parse_exr_channels(std::span<const std::byte> bytes, const std::string& name,
                                             const std::vector<std::string>& channels,
                                             const ExrLimits& limits = {});
std::vector<Plane<float>> read_exr_channels(const std::filesystem::path& path,
                                            const std::vector<std::string>& channels,
                                            const ExrLimits& limits = {});

/// The image held in channels R, G, B (or Y alone, as grey). Other channels are ignored.
SceneImage parse_exr_image(std::span<const std::byte> bytes, const std::string& name,
                           const ExrLimits& limits = {});
SceneImage read_exr_image(const std::filesystem::path& path, const ExrLimits& limits = {});

/// OpenEXR's standard attribute: luminance in cd/m² of the value (1, 1, 1). Images in cd/m² carry it as 1.
inline constexpr const char* kWhiteLuminance = "whiteLuminance";

enum class ExrCompression { kNone, kZip, kPiz };

/// How an OpenEXR file is written.
struct ExrWriteOptions {
  ExrPixelType colour_type = ExrPixelType::kHalf;  ///< kHalf or kFloat; extra channels are always float
  ExrCompression compression = ExrCompression::kZip;
  std::map<std::string, std::string> string_attributes;  ///< metadata beside the standard attributes
  std::map<std::string, float> float_attributes;
  /// Throws InputError for integer colour or for an attribute that would replace one OpenEXR itself uses.
  void validate() const;
};

/// One plane to write beside the colour; the planes must live until the call returns.
struct ExrExtraChannel {
  std::string name;
  const Plane<float>* plane = nullptr;
};

/// Writes channels R, G, B and the extra channels atomically. Throws InputError if a plane's size differs, if
/// the file cannot be written, or if a finite radiance is too large for half (beyond ±65504: choose float;
/// nothing is clamped silently).
void write_exr(const std::filesystem::path& path, const SceneImage& image,
               const std::vector<ExrExtraChannel>& extra = {}, const ExrWriteOptions& options = {});
/// The same for encoded display values, which are stored as they are.
void write_exr(const std::filesystem::path& path, const DisplayImage& image,
               const std::vector<ExrExtraChannel>& extra = {}, const ExrWriteOptions& options = {});

}  // namespace plenolab
