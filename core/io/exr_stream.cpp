#include "core/io/exr_stream.h"

#include <Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <cstring>
#include <exception>
#include <map>
#include <optional>

#include "core/base/error.h"

namespace plenolab {

ExrMemoryStream::ExrMemoryStream(std::span<const std::byte> bytes, const std::string& name)
    : Imf::IStream(name.c_str()), bytes_(bytes) {}

const std::byte* ExrMemoryStream::take(int count) {
  if (count < 0 || position_ > bytes_.size() || static_cast<uint64_t>(count) > bytes_.size() - position_)
    throw Iex::InputExc("unexpected end of file");
  const std::byte* data = bytes_.data() + position_;
  position_ += static_cast<uint64_t>(count);
  return data;
}

bool ExrMemoryStream::read(char destination[], int count) {
  const std::byte* data = take(count);
  if (count > 0) std::memcpy(destination, data, static_cast<std::size_t>(count));
  return position_ < bytes_.size();
}

// OpenEXR's interface wants a mutable pointer but only reads through it.
char* ExrMemoryStream::readMemoryMapped(int count) {
  return const_cast<char*>(reinterpret_cast<const char*>(take(count)));
}

namespace {

// Walks the raw attributes (name, type, size, value) and refuses sizes beyond the file before OpenEXR
// allocates them.
class AttributeWalk {
 public:
  AttributeWalk(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void check_headers(bool multipart) {
    check_one_header();
    while (multipart && peek() != 0) check_one_header();
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    throw InputError(fmt::format("{} is a damaged OpenEXR file: {}", name_, why));
  }

  unsigned char peek() const {
    if (position_ >= bytes_.size()) damaged("it ends inside the header");
    return std::to_integer<unsigned char>(bytes_[position_]);
  }

  std::string read_text() {
    std::string text;
    for (; peek() != 0; ++position_) text += static_cast<char>(peek());
    ++position_;
    return text;
  }

  std::int32_t read_int() {
    if (bytes_.size() - position_ < 4) damaged("it ends inside the header");
    std::int32_t value = 0;
    std::memcpy(&value, bytes_.data() + position_, 4);
    position_ += 4;
    return value;
  }

  void check_one_header() {
    while (peek() != 0) {
      const std::string attribute = read_text();
      const std::string type = read_text();
      const std::int32_t size = read_int();
      if (size < 0 || static_cast<std::size_t>(size) > bytes_.size() - position_)
        damaged(fmt::format("an attribute claims {} bytes of the {} that are left", size,
                            bytes_.size() - position_));
      check_value(attribute, type, size);
      position_ += static_cast<std::size_t>(size);
    }
    ++position_;
  }

  /// OpenEXR reads values of these types by their own length, whatever size the file states: where the two
  /// differ, it would go on in the middle of something else and take any bytes for the length of the next
  /// attribute.
  void check_value(const std::string& attribute, const std::string& type, std::int32_t size) {
    std::optional<std::int64_t> needed;
    if (const auto fixed = kFixedSizes.find(type); fixed != kFixedSizes.end()) needed = fixed->second;
    if (type == "chlist") needed = channel_list_size();
    if (type == "preview") needed = preview_size(size);
    if (needed && *needed != size)
      damaged(fmt::format("attribute '{}' of type {} has {} bytes instead of {}", attribute, type, size,
                          *needed));
  }

  std::int64_t channel_list_size() {
    const std::size_t begin = position_;
    while (peek() != 0) {
      read_text();
      constexpr std::size_t kChannelBytes = 16;  // pixel type, linearity, reserved, x and y sampling
      if (bytes_.size() - position_ < kChannelBytes) damaged("it ends inside the channel list");
      position_ += kChannelBytes;
    }
    const auto length = static_cast<std::int64_t>(position_ + 1 - begin);
    position_ = begin;
    return length;
  }

  std::int64_t preview_size(std::int32_t stated) {
    if (stated < 8) return 8;
    const std::size_t begin = position_;
    const std::int64_t width = static_cast<std::uint32_t>(read_int());
    const std::int64_t height = static_cast<std::uint32_t>(read_int());
    position_ = begin;
    constexpr std::int64_t kMaxSide = 1 << 14;
    if (width > kMaxSide || height > kMaxSide)
      damaged(fmt::format("its preview claims {}×{} pixels", width, height));
    return 8 + 4 * width * height;
  }

  /// Bytes of the values of types of one length (OpenEXR File Layout, "Predefined Attribute Types").
  static inline const std::map<std::string, std::int64_t> kFixedSizes{{"box2i", 16},
                                                                      {"box2f", 16},
                                                                      {"chromaticities", 32},
                                                                      {"compression", 1},
                                                                      {"deepImageState", 1},
                                                                      {"double", 8},
                                                                      {"envmap", 1},
                                                                      {"float", 4},
                                                                      {"int", 4},
                                                                      {"keycode", 28},
                                                                      {"lineOrder", 1},
                                                                      {"m33f", 36},
                                                                      {"m33d", 72},
                                                                      {"m44f", 64},
                                                                      {"m44d", 128},
                                                                      {"rational", 8},
                                                                      {"tiledesc", 9},
                                                                      {"timecode", 8},
                                                                      {"v2i", 8},
                                                                      {"v2f", 8},
                                                                      {"v2d", 16},
                                                                      {"v3i", 12},
                                                                      {"v3f", 12},
                                                                      {"v3d", 24}};

  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t position_ = 8;
};

constexpr std::int64_t kOffsetAndChunkHeaderBytes = 16;  // 8 in the offset table, at least 8 before the data

// Scan lines one chunk holds at most, over all compressions (DWAB).
constexpr std::int64_t kMaxLinesPerChunk = 256;

std::int64_t lines_per_chunk(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    default:
      return kMaxLinesPerChunk;
  }
}

std::int64_t ceil_div(std::int64_t a, std::int64_t b) {
  return (a + b - 1) / b;
}

struct PartExtent {
  std::int64_t width = 0, height = 0;
};

PartExtent extent_of(const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  return {std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1};
}

std::int64_t bytes_per_pixel(const Imf::Header& header) {
  std::int64_t bytes = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    bytes += it.channel().type == Imf::HALF ? 2 : 4;
  return bytes;
}

constexpr std::int64_t kMaxTileBytes = std::int64_t{256} << 20;

std::int64_t chunk_count(const Imf::Header& header, const PartExtent& extent, const std::string& name) {
  if (!header.hasTileDescription()) return ceil_div(extent.height, lines_per_chunk(header.compression()));
  const Imf::TileDescription& tiles = header.tileDescription();
  const std::int64_t tile_pixels = std::int64_t{tiles.xSize} * std::int64_t{tiles.ySize};
  if (tiles.xSize < 1 || tiles.ySize < 1 || tiles.xSize > (1u << 20) || tiles.ySize > (1u << 20) ||
      tile_pixels * std::max<std::int64_t>(bytes_per_pixel(header), 4) > kMaxTileBytes)
    throw InputError(
        fmt::format("{} is a damaged OpenEXR file: its tiles of {} × {} pixels are beyond any use", name,
                    tiles.xSize, tiles.ySize));
  return ceil_div(extent.width, tiles.xSize) * ceil_div(extent.height, tiles.ySize);
}

// A compressed file may be much smaller than its pixels, but not without bound: constant images reach some
// thousands.
constexpr std::int64_t kMaxCompressionRatio = 16384;
constexpr std::int64_t kAlwaysPlausibleBytes = std::int64_t{128} << 20;

void check_extent(const Imf::Header& header, std::uint64_t file_bytes, const std::string& name,
                  const ExrLimits& limits) {
  const PartExtent extent = extent_of(header);
  if (extent.width < 1 || extent.height < 1)
    throw InputError(fmt::format("{} is a damaged OpenEXR file: its data window is empty", name));
  if (extent.width > limits.max_pixels / extent.height)
    throw InputError(fmt::format("{} claims {} × {} pixels, more than the {} allowed here", name,
                                 extent.width, extent.height, limits.max_pixels));
  const std::int64_t chunks = chunk_count(header, extent, name);
  const std::int64_t size = static_cast<std::int64_t>(file_bytes);
  const std::int64_t raw = extent.width * extent.height * std::max<std::int64_t>(bytes_per_pixel(header), 1);
  if (chunks > size / kOffsetAndChunkHeaderBytes ||
      (raw > kAlwaysPlausibleBytes && raw / kMaxCompressionRatio > size))
    throw InputError(
        fmt::format("{} is a damaged or truncated OpenEXR file: {} × {} pixels cannot be in {} bytes", name,
                    extent.width, extent.height, size));
}

std::vector<Imf::Header> read_headers(ExrMemoryStream& stream, std::span<const std::byte> bytes,
                                      bool multipart, int version) {
  std::vector<Imf::Header> headers;
  stream.seekg(8);
  do {
    headers.emplace_back();
    headers.back().readFrom(stream, version);
  } while (multipart && stream.tellg() < bytes.size() && bytes[stream.tellg()] != std::byte{0});
  return headers;
}

}  // namespace

bool is_deep(const Imf::Header& header) {
  return header.hasType() && Imf::isDeepData(header.type());
}

std::vector<Imf::Header> scan_exr_headers(std::span<const std::byte> bytes, std::uint64_t file_bytes,
                                          const std::string& name, const ExrLimits& limits) {
  limits.validate();
  std::int32_t magic_and_version[2] = {0, 0};
  if (bytes.size() >= 8) std::memcpy(magic_and_version, bytes.data(), 8);
  if (magic_and_version[0] != Imf::MAGIC) throw InputError(fmt::format("{} is not an OpenEXR file", name));
  const int version = magic_and_version[1];
  if (Imf::getVersion(version) != Imf::EXR_VERSION || !Imf::supportsFlags(Imf::getFlags(version)))
    throw InputError(fmt::format("{} is written in an OpenEXR version this program does not know", name));
  try {
    AttributeWalk(bytes, name).check_headers(Imf::isMultiPart(version));
    ExrMemoryStream stream(bytes, name);
    std::vector<Imf::Header> headers = read_headers(stream, bytes, Imf::isMultiPart(version), version);
    for (Imf::Header& header : headers) {
      // Single tiled parts need not say their type; without it the sanity check would take them for scan
      // lines.
      header.sanityCheck(Imf::isTiled(version) || (header.hasType() && Imf::isTiled(header.type())),
                         Imf::isMultiPart(version));
      check_extent(header, file_bytes, name, limits);
    }
    return headers;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{} is a damaged OpenEXR file: {}", name, error.what()));
  }
}

}  // namespace plenolab
