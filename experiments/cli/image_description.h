#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace plenolab {

/// One channel of an image file.
struct ChannelDescription {
  std::string part;  ///< of a multi-part EXR; empty otherwise
  std::string name;
  std::string type;             ///< as stored: "half", "float", "uint", "rgbe", "8 bit", "16 bit"
  bool measured = false;        ///< whether its values were looked at: not those of deep data
  double least = 0, most = 0;   ///< of the finite values, as read; both 0 if there is none
  std::int64_t not_finite = 0;  ///< values that are NaN or infinite
};

/// What an image file says about itself.
struct ImageDescription {
  int width = 0, height = 0;  ///< of the first part
  bool has_colour = false;    ///< whether it can be read as an image (core/io/image_file.h)
  std::vector<ChannelDescription> channels;
  std::vector<std::pair<std::string, std::string>> metadata;  ///< printable, as in the file
};

/// Describes an .exr, .hdr (.pic), .pfm or .png file: channels, their types and ranges, and the metadata of
/// its header (EXR: texts and numbers of all parts, .hdr: NAME=VALUE lines and comments, .png: tEXt chunks
/// before the pixels). Throws InputError as the readers of core/io do.
ImageDescription describe_image(const std::filesystem::path& path);

}  // namespace plenolab
