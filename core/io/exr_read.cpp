#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <iterator>

#include "core/base/error.h"
#include "core/io/bytes.h"
#include "core/io/exr.h"
#include "core/io/exr_stream.h"
#include "core/io/exr_threads.h"

namespace plenolab {

namespace {

ExrPixelType pixel_type(Imf::PixelType type) {
  return type == Imf::HALF    ? ExrPixelType::kHalf
         : type == Imf::FLOAT ? ExrPixelType::kFloat
                              : ExrPixelType::kUint;
}

ExrPartInfo describe_part(const Imf::Header& header) {
  ExrPartInfo part;
  const Imath::Box2i window = header.dataWindow();
  part.width = window.max.x - window.min.x + 1;
  part.height = window.max.y - window.min.y + 1;
  part.deep = is_deep(header);
  if (header.hasName()) part.name = header.name();
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    part.channels.push_back({it.name(), pixel_type(it.channel().type)});
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
      part.string_attributes[it.name()] = text->value();
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&it.attribute()))
      part.float_attributes[it.name()] = number->value();
  }
  return part;
}

std::vector<ExrPartInfo> describe_parts(const std::vector<Imf::Header>& headers) {
  std::vector<ExrPartInfo> parts;
  std::transform(headers.begin(), headers.end(), std::back_inserter(parts), describe_part);
  return parts;
}

bool holds_all(const Imf::Header& header, const std::vector<std::string>& channels) {
  return std::all_of(channels.begin(), channels.end(),
                     [&](const std::string& c) { return header.channels().findChannel(c) != nullptr; });
}

std::string channel_names(const std::vector<Imf::Header>& headers) {
  std::vector<std::string> names;
  for (const Imf::Header& header : headers)
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
      names.emplace_back(it.name());
  if (names.size() > 20) {
    names.resize(20);
    names.emplace_back("…");
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

int part_with(const std::vector<Imf::Header>& headers, const std::vector<std::string>& channels,
              const std::string& name) {
  const auto part = std::find_if(headers.begin(), headers.end(),
                                 [&](const Imf::Header& h) { return holds_all(h, channels); });
  if (part == headers.end())
    throw InputError(fmt::format("{} has no part with the channel(s) {}; it holds {}", name,
                                 fmt::join(channels, ", "), channel_names(headers)));
  return static_cast<int>(part - headers.begin());
}

void check_readable(const Imf::Header& header, const std::vector<std::string>& channels,
                    const std::string& name) {
  if (is_deep(header))
    throw InputError(
        fmt::format("{} holds deep data (several samples a pixel): flatten it to one sample first", name));
  for (const std::string& channel : channels) {
    const Imf::Channel* c = header.channels().findChannel(channel);
    if (c->xSampling != 1 || c->ySampling != 1)
      throw InputError(fmt::format("channel {} of {} is subsampled {} × {}: store it at full resolution",
                                   channel, name, c->xSampling, c->ySampling));
  }
}

// OpenEXR addresses pixel (x, y) of the data window as base + x·xStride + y·yStride, in whatever sign x and y
// have.
char* base_of(Plane<float>& plane, const Imath::Box2i& window) {
  const std::intptr_t offset =
      static_cast<std::intptr_t>(window.min.x) +
      static_cast<std::intptr_t>(window.min.y) * static_cast<std::intptr_t>(plane.width());
  const std::intptr_t start = reinterpret_cast<std::intptr_t>(plane.row(0));
  return reinterpret_cast<char*>(start - offset * static_cast<std::intptr_t>(sizeof(float)));
}

std::vector<Plane<float>> read_planes(Imf::MultiPartInputFile& file, int part_number,
                                      const std::vector<std::string>& channels) {
  if (!file.partComplete(part_number)) throw Iex::InputExc("it is incomplete");
  Imf::InputPart part(file, part_number);
  const Imath::Box2i window = part.header().dataWindow();
  const int width = window.max.x - window.min.x + 1;
  const int height = window.max.y - window.min.y + 1;
  std::vector<Plane<float>> planes(channels.size(), Plane<float>(width, height));
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < channels.size(); ++i)
    buffer.insert(channels[i], Imf::Slice(Imf::FLOAT, base_of(planes[i], window), sizeof(float),
                                          sizeof(float) * static_cast<std::size_t>(width)));
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
  return planes;
}

}  // namespace

bool ExrPartInfo::has_channel(const std::string& channel) const {
  return std::any_of(channels.begin(), channels.end(),
                     [&](const ExrChannelInfo& c) { return c.name == channel; });
}

void ExrLimits::validate() const {
  if (max_pixels < 1)
    throw InputError(fmt::format("the limit on pixels must be positive, not {}", max_pixels));
  if (max_file_bytes < 1) throw InputError("the limit on the file size must be positive, not 0");
}

std::vector<ExrPartInfo> parse_exr_header(std::span<const std::byte> bytes, const std::string& name,
                                          const ExrLimits& limits) {
  return describe_parts(scan_exr_headers(bytes, bytes.size(), name, limits));
}

std::vector<ExrPartInfo> read_exr_header(const std::filesystem::path& path, const ExrLimits& limits) {
  // Enough for all but files with previews or long metadata, of which the whole is read.
  constexpr std::uint64_t kUsualHeaderBytes = 1 << 16;
  const std::vector<std::byte> beginning = read_beginning(path, kUsualHeaderBytes);
  const std::uint64_t file_bytes = size_of_file(path);
  if (beginning.size() < file_bytes) {
    try {
      return describe_parts(scan_exr_headers(beginning, file_bytes, path.string(), limits));
    } catch (const InputError&) {
      // Damaged, or the headers go on: the whole file decides.
    }
  }
  return parse_exr_header(read_bytes(path, limits.max_file_bytes), path.string(), limits);
}

std::vector<Plane<float>> parse_exr_channels(std::span<const std::byte> bytes, const std::string& name,
                                             const std::vector<std::string>& channels,
                                             const ExrLimits& limits) {
  const std::vector<Imf::Header> headers = scan_exr_headers(bytes, bytes.size(), name, limits);
  const int part = part_with(headers, channels, name);
  check_readable(headers[static_cast<std::size_t>(part)], channels, name);
  try {
    ExrMemoryStream stream(bytes, name);
    // A lost offset table is not reconstructed: such a file was not finished, and missing lines would read as
    // zeros.
    Imf::MultiPartInputFile file(stream, exr_threads(), false);
    return read_planes(file, part, channels);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{} is a damaged or truncated OpenEXR file: {}", name, error.what()));
  }
}

std::vector<Plane<float>> read_exr_channels(const std::filesystem::path& path,
                                            const std::vector<std::string>& channels,
                                            const ExrLimits& limits) {
  return parse_exr_channels(read_bytes(path, limits.max_file_bytes), path.string(), channels, limits);
}

SceneImage parse_exr_image(std::span<const std::byte> bytes, const std::string& name,
                           const ExrLimits& limits) {
  const std::vector<ExrPartInfo> parts = parse_exr_header(bytes, name, limits);
  const auto has_rgb = [](const ExrPartInfo& p) {
    return p.has_channel("R") && p.has_channel("G") && p.has_channel("B");
  };
  const bool rgb = std::any_of(parts.begin(), parts.end(), has_rgb);
  const bool grey = !rgb && std::any_of(parts.begin(), parts.end(), [](const ExrPartInfo& p) {
    return p.has_channel("Y") && !p.has_channel("RY");
  });
  const std::vector<std::string> channels =
      grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  const std::vector<Plane<float>> planes = parse_exr_channels(bytes, name, channels, limits);
  SceneImage image(planes[0].width(), planes[0].height());
  const std::size_t g = grey ? 0 : 1;
  const std::size_t b = grey ? 0 : 2;
  for (std::size_t i = 0; i < image.size(); ++i)
    image.pixels()[i] = {planes[0].pixels()[i], planes[g].pixels()[i], planes[b].pixels()[i]};
  return image;
}

SceneImage read_exr_image(const std::filesystem::path& path, const ExrLimits& limits) {
  return parse_exr_image(read_bytes(path, limits.max_file_bytes), path.string(), limits);
}

}  // namespace plenolab
