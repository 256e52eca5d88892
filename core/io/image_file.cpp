#include "core/io/image_file.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/bytes.h"
#include "core/io/exr.h"
#include "core/io/find_value.h"
#include "core/io/pfm.h"
#include "core/io/radiance_hdr.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMaxPngBytes = std::uint64_t{1} << 30;
constexpr std::int64_t kMaxPngPixels = std::int64_t{1} << 28;

/// For a file to be read: one that is missing is told first.
void require_exists(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(fmt::format("{} does not exist", path.string()));
}

[[noreturn]] void unsupported(const fs::path& path, const char* kind, const char* supported) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw InputError(fmt::format("{} is a folder; give one image: {}", path.string(), supported));
  throw InputError(fmt::format("{} has the extension \"{}\"; {} images are {}", path.string(),
                               path.extension().string(), kind, supported));
}

constexpr const char* kSceneFormats = ".exr, .hdr (.pic) or .pfm (a .png holds display values, not radiance)";
constexpr const char* kDisplayFormats = ".png (radiance in .exr, .hdr or .pfm has to be tone mapped first)";

// Size from the IHDR chunk, checked before the decoder allocates anything.
void check_png_header(std::span<const std::byte> bytes, const std::string& name) {
  constexpr unsigned char kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  bool png = bytes.size() >= 33;
  for (std::size_t i = 0; png && i < 8; ++i) png = std::to_integer<unsigned char>(bytes[i]) == kSignature[i];
  if (!png) throw InputError(fmt::format("{} is not a PNG file", name));
  const auto big_endian = [&](std::size_t at) {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value * 256 + std::to_integer<int>(bytes[at + i]);
    return value;
  };
  const std::int64_t width = big_endian(16), height = big_endian(20);
  const std::int64_t size = static_cast<std::int64_t>(bytes.size());
  // Deflate shrinks by at most 1032 : 1.
  if (width < 1 || height < 1 || width > kMaxPngPixels / height || height > size * 1032 ||
      width > size * 1032 / height * 8)
    throw InputError(
        fmt::format("{} is a damaged PNG file: {} × {} pixels in {} bytes", name, width, height, size));
}

cv::Mat decode_png(const std::vector<std::byte>& bytes, const std::string& name) {
  check_png_header(bytes, name);
  cv::Mat decoded;
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                      const_cast<void*>(static_cast<const void*>(bytes.data())));
    decoded = cv::imdecode(raw, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw InputError(fmt::format("{} is a damaged PNG file: {}", name, error.err));
  }
  if (decoded.empty() || decoded.channels() != 3 || (decoded.depth() != CV_8U && decoded.depth() != CV_16U))
    throw InputError(fmt::format("{} is a damaged PNG file", name));
  return decoded;
}

template <class Code>
void copy_codes(const cv::Mat& codes, DisplayImage& image, float white) {
  for (int y = 0; y < image.height(); ++y) {
    const Code* bgr = codes.ptr<Code>(y);
    for (int x = 0; x < image.width(); ++x, bgr += 3)
      image.at(x, y) = {static_cast<float>(bgr[2]) / white, static_cast<float>(bgr[1]) / white,
                        static_cast<float>(bgr[0]) / white};
  }
}

void check_in_range(const DisplayImage& image, const std::string& name) {
  if (image.empty()) throw InputError(fmt::format("cannot write {}: the image has no pixels", name));
  if (const auto bad = find_value(image, [](float v) { return !(v >= 0 && v <= 1); }))
    throw InputError(fmt::format("cannot write {}: the display value {} at pixel ({}, {}) is outside [0, 1]",
                                 name, bad->value, bad->x, bad->y));
}

template <class Code>
cv::Mat to_codes(const DisplayImage& image, int type, float white) {
  cv::Mat codes(image.height(), image.width(), type);
  const auto code = [white](float v) { return static_cast<Code>(std::lround(v * white)); };
  for (int y = 0; y < image.height(); ++y) {
    Code* bgr = codes.ptr<Code>(y);
    for (int x = 0; x < image.width(); ++x, bgr += 3) {
      const Rgb c = image.at(x, y);
      bgr[0] = code(c.b);
      bgr[1] = code(c.g);
      bgr[2] = code(c.r);
    }
  }
  return codes;
}

}  // namespace

SceneImage read_scene_image(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".exr") return read_exr_image(path);
  if (extension == ".hdr" || extension == ".pic") return read_radiance_hdr(path);
  if (extension == ".pfm") return read_pfm_image(path);
  require_exists(path);
  unsupported(path, "scene-referred", kSceneFormats);
}

DisplayImage read_display_image(const fs::path& path) {
  require_exists(path);
  if (lower_extension(path) != ".png") unsupported(path, "display-referred", kDisplayFormats);
  const cv::Mat codes = decode_png(read_bytes(path, kMaxPngBytes), path.string());
  DisplayImage image(codes.cols, codes.rows);
  if (codes.depth() == CV_8U)
    copy_codes<std::uint8_t>(codes, image, 255.0f);
  else
    copy_codes<std::uint16_t>(codes, image, 65535.0f);
  return image;
}

void write_scene_image(const fs::path& path, const SceneImage& image, std::optional<double> cd_m2_per_unit) {
  const std::string extension = lower_extension(path);
  ExrWriteOptions options;
  options.colour_type = ExrPixelType::kFloat;
  if (cd_m2_per_unit) options.float_attributes[kWhiteLuminance] = static_cast<float>(*cd_m2_per_unit);
  if (extension == ".exr") return write_exr(path, image, {}, options);
  if (extension == ".hdr" || extension == ".pic") return write_radiance_hdr(path, image);
  if (extension == ".pfm") return write_pfm(path, image);
  unsupported(path, "scene-referred", kSceneFormats);
}

void write_display_image(const fs::path& path, const DisplayImage& image, PngDepth depth) {
  if (lower_extension(path) != ".png") unsupported(path, "display-referred", kDisplayFormats);
  check_in_range(image, path.string());
  const cv::Mat codes = depth == PngDepth::k8Bit ? to_codes<std::uint8_t>(image, CV_8UC3, 255.0f)
                                                 : to_codes<std::uint16_t>(image, CV_16UC3, 65535.0f);
  std::vector<unsigned char> encoded;
  if (!cv::imencode(".png", codes, encoded))
    throw InputError(fmt::format("cannot write {}: {} × {} pixels do not fit a PNG", path.string(),
                                 image.width(), image.height()));
  write_atomically(path, [&](const fs::path& temporary) {
    write_bytes(temporary, std::as_bytes(std::span<const unsigned char>(encoded)));
  });
}

}  // namespace plenolab
