#include "experiments/cli/image_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/io/bytes.h"
#include "core/io/exr.h"
#include "experiments/cli/inputs.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kHeaderBytes = 1 << 20;  ///< metadata further behind is not looked for

std::string printable(std::string_view text) {
  std::string result(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; },
      ' ');
  return result;
}

void measure_value(ChannelDescription& channel, float value) {
  if (!std::isfinite(value)) {
    ++channel.not_finite;
    return;
  }
  channel.least = std::min(channel.least, double{value});
  channel.most = std::max(channel.most, double{value});
}

template <class Measure>
void measure_channel(ChannelDescription& channel, const Measure& each) {
  channel.measured = true;
  channel.least = std::numeric_limits<double>::infinity();
  channel.most = -channel.least;
  each(channel);
  if (channel.least > channel.most) channel.least = channel.most = 0;
}

const char* name_of(ExrPixelType type) {
  return type == ExrPixelType::kHalf ? "half" : type == ExrPixelType::kFloat ? "float" : "uint";
}

std::vector<std::string> names_of(const ExrPartInfo& part) {
  std::vector<std::string> names;
  for (const ExrChannelInfo& channel : part.channels) names.push_back(channel.name);
  return names;
}

/// Whether reading these channels gives those of this part, not those of an earlier one.
bool is_readable(const std::vector<ExrPartInfo>& parts, std::size_t index) {
  const std::vector<std::string> names = names_of(parts[index]);
  const auto holds_all = [&](const ExrPartInfo& part) {
    return std::all_of(names.begin(), names.end(), [&](const auto& name) { return part.has_channel(name); });
  };
  return !parts[index].deep && !names.empty() &&
         std::none_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(index), holds_all);
}

void add_exr_part(ImageDescription& description, const fs::path& path, const std::vector<ExrPartInfo>& parts,
                  std::size_t index) {
  const ExrPartInfo& part = parts[index];
  std::vector<Plane<float>> planes;
  if (is_readable(parts, index)) planes = read_exr_channels(path, names_of(part));
  for (std::size_t i = 0; i < part.channels.size(); ++i) {
    ChannelDescription channel{
        .part = part.name, .name = part.channels[i].name, .type = name_of(part.channels[i].type)};
    if (!planes.empty())
      measure_channel(channel, [&](ChannelDescription& c) {
        for (const float value : planes[i].pixels()) measure_value(c, value);
      });
    description.channels.push_back(channel);
  }
  for (const auto& [name, text] : part.string_attributes)
    description.metadata.emplace_back(name, printable(text));
  for (const auto& [name, number] : part.float_attributes)
    description.metadata.emplace_back(name, fmt::format("{}", number));
}

ImageDescription describe_exr(const fs::path& path) {
  const std::vector<ExrPartInfo> parts = read_exr_header(path);
  ImageDescription description{.width = parts.front().width, .height = parts.front().height};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    add_exr_part(description, path, parts, i);
    const ExrPartInfo& p = parts[i];
    const bool rgb = p.has_channel("R") && p.has_channel("G") && p.has_channel("B");
    description.has_colour |= !p.deep && (rgb || p.has_channel("Y"));
  }
  return description;
}

/// Size and channels R, G, B of an image that was read.
template <class Image>
ImageDescription describe_rgb(const Image& image, const std::string& type) {
  ImageDescription description{.width = image.width(), .height = image.height(), .has_colour = true};
  for (const auto& [name, member] : {std::pair{"R", &Rgb::r}, {"G", &Rgb::g}, {"B", &Rgb::b}}) {
    ChannelDescription channel{.name = name, .type = type};
    measure_channel(channel, [&, member = member](ChannelDescription& c) {
      for (const Rgb& pixel : image.pixels()) measure_value(c, pixel.*member);
    });
    description.channels.push_back(channel);
  }
  return description;
}

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The lines between "#?RADIANCE" and the empty line before the size.
std::vector<std::pair<std::string, std::string>> hdr_metadata(const std::string& header) {
  std::vector<std::pair<std::string, std::string>> metadata;
  std::size_t begin = header.find('\n');
  while (begin != std::string::npos) {
    const std::size_t end = header.find('\n', ++begin);
    const std::string line = printable(header.substr(begin, end == std::string::npos ? end : end - begin));
    if (line.find_first_not_of(' ') == std::string::npos) break;
    const std::size_t equals = line.find('=');
    if (line[0] == '#' || equals == std::string::npos)
      metadata.emplace_back("comment", line.substr(line[0] == '#' ? 1 : 0));
    else
      metadata.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    begin = end;
  }
  return metadata;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// The tEXt chunks before the pixels: a keyword, a zero, a text.
std::vector<std::pair<std::string, std::string>> png_metadata(const std::string& file) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and checksum of a chunk
  std::vector<std::pair<std::string, std::string>> metadata;
  for (std::size_t at = kSignature; at + kFrame <= file.size();) {
    const std::size_t length = big_endian(file, at);
    const std::string type = file.substr(at + 4, 4);
    if (type == "IDAT" || length > file.size() - at - kFrame) break;
    const std::string data = file.substr(at + 8, length);
    if (const auto zero = data.find('\0'); type == "tEXt" && zero != std::string::npos)
      metadata.emplace_back(printable(data.substr(0, zero)), printable(data.substr(zero + 1)));
    at += kFrame + length;
  }
  return metadata;
}

std::string png_type(const std::string& file) {
  constexpr std::size_t kBitDepth = 24;  // in IHDR, the first chunk; the reader has checked that it is there
  return fmt::format("{} bit", static_cast<int>(static_cast<unsigned char>(file.at(kBitDepth))));
}

}  // namespace

ImageDescription describe_image(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".exr") return describe_exr(path);
  const AnyImage image = read_any_image(path);
  const std::string header = text_of(read_beginning(path, kHeaderBytes));
  if (const auto* display = std::get_if<DisplayImage>(&image)) {
    ImageDescription description = describe_rgb(*display, png_type(header));
    description.metadata = png_metadata(header);
    return description;
  }
  const bool rgbe = extension != ".pfm";
  ImageDescription description = describe_rgb(std::get<SceneImage>(image), rgbe ? "rgbe" : "float");
  if (rgbe) description.metadata = hdr_metadata(header);
  return description;
}

}  // namespace plenolab
