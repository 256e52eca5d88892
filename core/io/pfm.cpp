#include "core/io/pfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/bytes.h"

namespace plenolab {

namespace {

static_assert(std::endian::native == std::endian::little,
              "PFM files are written in the machine's byte order");

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{4} << 30;
constexpr std::size_t kMaxHeaderBytes = 256;

// Splits the header into words, as the three lines may be separated by any single white space.
class HeaderWords {
 public:
  HeaderWords(std::span<const std::byte> bytes, const std::string& name)
      : text_(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kMaxHeaderBytes)),
        name_(name) {}

  std::string_view next() {
    std::size_t begin = text_.find_first_not_of(kBlank, position_);
    // "#" comments are not in the format's description, but some programs write them.
    while (begin != std::string_view::npos && text_[begin] == '#')
      begin = text_.find_first_not_of(kBlank, std::min(text_.find('\n', begin), text_.size()));
    const std::size_t end = begin == std::string_view::npos ? begin : text_.find_first_of(kBlank, begin);
    if (end == std::string_view::npos)
      throw InputError(fmt::format("{} is a damaged or truncated PFM file: its header does not end", name_));
    position_ = end + 1;
    return text_.substr(begin, end - begin);
  }

  template <class Number>
  Number next_number() {
    const std::string_view word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      throw InputError(
          fmt::format("{} is a damaged PFM file: its header has a word that is not a number", name_));
    return value;
  }

  std::size_t position() const { return position_; }

 private:
  static constexpr std::string_view kBlank = " \t\r\n";
  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
};

float load_float(const std::byte* source, bool big_endian) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, source, sizeof bits);
  return std::bit_cast<float>(big_endian ? __builtin_bswap32(bits) : bits);
}

struct PfmHeader {
  int width = 0, height = 0;
  int channels = 1;
  bool big_endian = false;
  std::size_t data_begin = 0;
};

PfmHeader parse_header(std::span<const std::byte> bytes, const std::string& name) {
  const bool magic = bytes.size() >= 3 && bytes[0] == std::byte{'P'} &&
                     (bytes[1] == std::byte{'F'} || bytes[1] == std::byte{'f'});
  if (!magic)
    throw InputError(fmt::format("{} is not a PFM file (it must begin with \"PF\" or \"Pf\")", name));
  HeaderWords words(bytes, name);
  PfmHeader header;
  const std::string_view kind = words.next();
  if (kind != "PF" && kind != "Pf")
    throw InputError(fmt::format("{} is not a PFM file (it must begin with \"PF\" or \"Pf\")", name));
  header.channels = kind == "PF" ? 3 : 1;
  header.width = words.next_number<int>();
  header.height = words.next_number<int>();
  const double scale = words.next_number<double>();
  header.big_endian = scale > 0;
  header.data_begin = words.position();
  if (header.width < 1 || header.height < 1)
    throw InputError(
        fmt::format("{} is a damaged PFM file: {} × {} pixels", name, header.width, header.height));
  if (!std::isfinite(scale) || scale == 0)
    throw InputError(fmt::format("{} is a damaged PFM file: the scale {} says no byte order", name, scale));
  const std::uint64_t floats = (bytes.size() - header.data_begin) / sizeof(float);
  const std::uint64_t row =
      static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.channels);
  if (floats / row < static_cast<std::uint64_t>(header.height) ||
      bytes.size() - header.data_begin != row * static_cast<std::uint64_t>(header.height) * sizeof(float))
    throw InputError(fmt::format("{} is a damaged or truncated PFM file: {} × {} pixels do not take {} bytes",
                                 name, header.width, header.height, bytes.size() - header.data_begin));
  return header;
}

void append_header(std::vector<std::byte>& out, const char* kind, int width, int height) {
  const std::string header = fmt::format("{}\n{} {}\n-1.0\n", kind, width, height);
  const auto* begin = reinterpret_cast<const std::byte*>(header.data());
  out.insert(out.end(), begin, begin + header.size());
}

template <class Pixel>
void write_any(const std::filesystem::path& path, const char* kind, const Plane<Pixel>& plane) {
  if (plane.empty()) throw InputError(fmt::format("cannot write {}: the image has no pixels", path.string()));
  std::vector<std::byte> out;
  out.reserve(kMaxHeaderBytes + plane.size() * sizeof(Pixel));
  append_header(out, kind, plane.width(), plane.height());
  for (int y = plane.height() - 1; y >= 0; --y) {
    const auto* row = reinterpret_cast<const std::byte*>(plane.row(y));
    out.insert(out.end(), row, row + static_cast<std::size_t>(plane.width()) * sizeof(Pixel));
  }
  write_atomically(path, [&](const std::filesystem::path& temporary) { write_bytes(temporary, out); });
}

}  // namespace

PfmImage parse_pfm(std::span<const std::byte> bytes, const std::string& name) {
  const PfmHeader header = parse_header(bytes, name);
  PfmImage image;
  image.is_colour = header.channels == 3;
  if (image.is_colour)
    image.colour = SceneImage(header.width, header.height);
  else
    image.grey = Plane<float>(header.width, header.height);
  const std::byte* source = bytes.data() + header.data_begin;
  const auto next = [&] {
    const float value = load_float(source, header.big_endian);
    source += sizeof(float);
    return value;
  };
  for (int y = header.height - 1; y >= 0; --y)
    for (int x = 0; x < header.width; ++x) {
      if (image.is_colour) {
        Rgb& c = image.colour.at(x, y);
        c.r = next();
        c.g = next();
        c.b = next();
      } else {
        image.grey.at(x, y) = next();
      }
    }
  return image;
}

Plane<float> read_pfm_plane(const std::filesystem::path& path) {
  PfmImage image = parse_pfm(read_bytes(path, kMaxFileBytes), path.string());
  if (image.is_colour)
    throw InputError(
        fmt::format("{} is a colour PFM (\"PF\"), but a single plane (\"Pf\") is needed", path.string()));
  return std::move(image.grey);
}

SceneImage read_pfm_image(const std::filesystem::path& path) {
  PfmImage image = parse_pfm(read_bytes(path, kMaxFileBytes), path.string());
  if (image.is_colour) return std::move(image.colour);
  SceneImage colour(image.grey.width(), image.grey.height());
  std::transform(image.grey.pixels().begin(), image.grey.pixels().end(), colour.pixels().begin(),
                 [](float v) {
                   return Rgb{v, v, v};
                 });
  return colour;
}

void write_pfm(const std::filesystem::path& path, const Plane<float>& plane) {
  write_any(path, "Pf", plane);
}

void write_pfm(const std::filesystem::path& path, const SceneImage& image) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  write_any<Rgb>(path, "PF", image);
}

}  // namespace plenolab
