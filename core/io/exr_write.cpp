#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/parallel.h"
#include "core/io/bytes.h"
#include "core/io/exr.h"
#include "core/io/exr_threads.h"
#include "core/io/find_value.h"

namespace plenolab {

int exr_threads() {
  static std::once_flag started;
  std::call_once(started, [] { Imf::setGlobalThreadCount(resolve_threads(0)); });
  return Imf::globalThreadCount();
}

void ExrWriteOptions::validate() const {
  if (colour_type == ExrPixelType::kUint)
    throw InputError("colour is written as half or float, not as unsigned integers");
  const Imf::Header standard(1, 1);
  const auto check = [&](const std::string& name) {
    if (name.empty() || name.size() > 255 || standard.find(name) != standard.end() || name == "name" ||
        name == "type" || name == "version" || name == "chunkCount" || name == "tiles" || name == "preview")
      throw InputError(fmt::format(
          "the metadata name \"{}\" is empty, too long or used by OpenEXR itself: choose another", name));
  };
  for (const auto& [name, value] : string_attributes) check(name);
  for (const auto& [name, value] : float_attributes) check(name);
}

namespace {

constexpr float kLargestHalf = 65504.0f;

void check_fits_half(const Plane<Rgb>& image, const std::string& path) {
  const auto beyond = [](float v) { return std::isfinite(v) && std::abs(v) > kLargestHalf; };
  if (const auto bad = find_value(image, beyond))
    throw InputError(fmt::format(
        "cannot write {}: the value {} at pixel ({}, {}) is beyond half precision (±65504): write "
        "32-bit float",
        path, bad->value, bad->x, bad->y));
}

Imf::Compression compression_of(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::kNone:
      return Imf::NO_COMPRESSION;
    case ExrCompression::kPiz:
      return Imf::PIZ_COMPRESSION;
    default:
      return Imf::ZIP_COMPRESSION;
  }
}

Imf::Header header_for(const Plane<Rgb>& image, const std::vector<ExrExtraChannel>& extra,
                       const ExrWriteOptions& options) {
  Imf::Header header(image.width(), image.height());
  header.compression() = compression_of(options.compression);
  const Imf::PixelType colour = options.colour_type == ExrPixelType::kHalf ? Imf::HALF : Imf::FLOAT;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(colour));
  for (const ExrExtraChannel& channel : extra)
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, value] : options.string_attributes)
    header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : options.float_attributes) header.insert(name, Imf::FloatAttribute(value));
  return header;
}

// OpenEXR only reads through these pointers, although its interface takes them as mutable.
template <class T>
void insert_slice(Imf::FrameBuffer& buffer, const std::string& name, Imf::PixelType type, const T* first,
                  std::size_t pixel_stride, int width) {
  char* base = const_cast<char*>(reinterpret_cast<const char*>(first));
  buffer.insert(name, Imf::Slice(type, base, pixel_stride, pixel_stride * static_cast<std::size_t>(width)));
}

struct HalfRgb {
  half r, g, b;
};

std::vector<HalfRgb> to_half(const Plane<Rgb>& image) {
  std::vector<HalfRgb> out;
  out.reserve(image.size());
  for (const Rgb& c : image.pixels()) out.push_back({half(c.r), half(c.g), half(c.b)});
  return out;
}

// Collects the file in memory: written in one go, so that a full disk is noticed (OpenEXR's own stream hides
// a failing last flush in its destructor).
class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& name) : Imf::OStream(name.c_str()) {}
  void write(const char data[], int count) override {
    const std::size_t end = position_ + static_cast<std::size_t>(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + position_, data, static_cast<std::size_t>(count));
    position_ = end;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t position_ = 0;
};

void write_pixels(MemoryOutput& output, const Plane<Rgb>& image, const std::vector<ExrExtraChannel>& extra,
                  const ExrWriteOptions& options) {
  const int width = image.width();
  Imf::FrameBuffer buffer;
  std::vector<HalfRgb> halves;
  if (options.colour_type == ExrPixelType::kHalf) {
    halves = to_half(image);
    insert_slice(buffer, "R", Imf::HALF, &halves[0].r, sizeof(HalfRgb), width);
    insert_slice(buffer, "G", Imf::HALF, &halves[0].g, sizeof(HalfRgb), width);
    insert_slice(buffer, "B", Imf::HALF, &halves[0].b, sizeof(HalfRgb), width);
  } else {
    insert_slice(buffer, "R", Imf::FLOAT, &image.pixels()[0].r, sizeof(Rgb), width);
    insert_slice(buffer, "G", Imf::FLOAT, &image.pixels()[0].g, sizeof(Rgb), width);
    insert_slice(buffer, "B", Imf::FLOAT, &image.pixels()[0].b, sizeof(Rgb), width);
  }
  for (const ExrExtraChannel& channel : extra)
    insert_slice(buffer, channel.name, Imf::FLOAT, channel.plane->row(0), sizeof(float), width);
  Imf::OutputFile file(output, header_for(image, extra, options), exr_threads());
  file.setFrameBuffer(buffer);
  file.writePixels(image.height());
}

void check_extra(const Plane<Rgb>& image, const std::vector<ExrExtraChannel>& extra,
                 const std::string& path) {
  for (const ExrExtraChannel& channel : extra) {
    PLENOLAB_CHECK(channel.plane, channel.name);
    if (channel.name.empty() || channel.name == "R" || channel.name == "G" || channel.name == "B")
      throw InputError(
          fmt::format("cannot write {}: an extra channel cannot be called \"{}\"", path, channel.name));
    if (channel.plane->width() != image.width() || channel.plane->height() != image.height())
      throw InputError(fmt::format("cannot write {}: channel {} has {} × {} pixels, the image {} × {}", path,
                                   channel.name, channel.plane->width(), channel.plane->height(),
                                   image.width(), image.height()));
  }
}

void write_any(const std::filesystem::path& path, const Plane<Rgb>& image,
               const std::vector<ExrExtraChannel>& extra, const ExrWriteOptions& options) {
  options.validate();
  if (image.empty()) throw InputError(fmt::format("cannot write {}: the image has no pixels", path.string()));
  check_extra(image, extra, path.string());
  if (options.colour_type == ExrPixelType::kHalf) check_fits_half(image, path.string());
  MemoryOutput output(path.string());
  try {
    write_pixels(output, image, extra, options);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("cannot write {}: {}", path.string(), error.what()));
  }
  write_atomically(path,
                   [&](const std::filesystem::path& temporary) { write_bytes(temporary, output.bytes()); });
}

}  // namespace

void write_exr(const std::filesystem::path& path, const SceneImage& image,
               const std::vector<ExrExtraChannel>& extra, const ExrWriteOptions& options) {
  write_any(path, image, extra, options);
}

void write_exr(const std::filesystem::path& path, const DisplayImage& image,
               const std::vector<ExrExtraChannel>& extra, const ExrWriteOptions& options) {
  write_any(path, image, extra, options);
}

}  // namespace plenolab
