#include "core/io/radiance_hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/bytes.h"
#include "core/io/find_value.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{4} << 30;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
// Run-length coding of scan lines is defined for these widths only; others are stored flat.
constexpr int kMinRleWidth = 8, kMaxRleWidth = 32767;

using Rgbe = std::array<std::uint8_t, 4>;

struct Header {
  int width = 0, height = 0;
  bool bottom_up = false, right_to_left = false;
  double exposure = 1;
};

class Parser {
 public:
  Parser(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  SceneImage parse() {
    const Header header = parse_header();
    SceneImage image(header.width, header.height);
    std::vector<Rgbe> line(static_cast<std::size_t>(header.width));
    const double scale = 1.0 / header.exposure;
    for (int i = 0; i < header.height; ++i) {
      read_line(line);
      Rgb* row = image.row(header.bottom_up ? header.height - 1 - i : i);
      for (int x = 0; x < header.width; ++x)
        row[header.right_to_left ? header.width - 1 - x : x] =
            decode(line[static_cast<std::size_t>(x)], scale);
    }
    return image;
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    throw InputError(fmt::format("{} is a damaged Radiance picture: {}", name_, why));
  }

  std::string_view next_line() {
    const std::size_t begin = position_;
    while (position_ < bytes_.size() && bytes_[position_] != std::byte{'\n'}) ++position_;
    if (position_ == bytes_.size()) damaged("it ends inside the header");
    const char* text = reinterpret_cast<const char*>(bytes_.data()) + begin;
    const std::size_t length = position_++ - begin;
    return std::string_view(text, length > 0 && text[length - 1] == '\r' ? length - 1 : length);
  }

  Header parse_header() {
    const std::string_view magic = bytes_.size() < 2 ? std::string_view{} : next_line();
    if (!magic.starts_with("#?"))
      throw InputError(fmt::format("{} is not a Radiance picture (\"#?RADIANCE\")", name_));
    Header header;
    for (std::string_view line = next_line(); !line.empty(); line = next_line()) {
      if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
        throw InputError(
            fmt::format("{} is not in FORMAT=32-bit_rle_rgbe: convert it (XYZE is not supported)", name_));
      if (line.starts_with("EXPOSURE=")) header.exposure *= parse_exposure(line.substr(9));
    }
    // Several EXPOSURE lines multiply, so only the product can be judged.
    if (!(header.exposure > 0) || !std::isfinite(header.exposure) || !std::isfinite(1.0 / header.exposure))
      damaged("its exposure is out of range");
    parse_resolution(next_line(), header);
    return header;
  }

  double parse_exposure(std::string_view text) const {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    double value = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc{})
      damaged("EXPOSURE is not a number");
    return value;
  }

  // "-Y height +X width" and its mirrored forms.
  void parse_resolution(std::string_view line, Header& header) const {
    const auto axis = [&](char name, bool& negative) {
      if (line.size() < 4 || (line[0] != '-' && line[0] != '+') || line[1] != name || line[2] != ' ')
        throw InputError(
            fmt::format("{} is oriented in a way that is not supported (\"{}\"): only ±Y height ±X width is",
                        name_, line.size() < 40 && is_printable(line) ? line : "?"));
      negative = line[0] == '-';
      line.remove_prefix(3);
      int value = 0;
      const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
      if (error != std::errc{} || value < 1) damaged("its size is not a positive number");
      line.remove_prefix(static_cast<std::size_t>(end - line.data()));
      line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
      return value;
    };
    bool y_negative = false, x_negative = false;
    header.height = axis('Y', y_negative);
    header.width = axis('X', x_negative);
    header.bottom_up = !y_negative;
    header.right_to_left = x_negative;
    if (!line.empty()) damaged(fmt::format("its size line has {} bytes too many", line.size()));
    if (header.width > kMaxPixels / header.height)
      throw InputError(fmt::format("{} claims {} × {} pixels, more than the {} allowed", name_, header.width,
                                   header.height, kMaxPixels));
    check_size(header);
  }

  // New run-length coding holds at most 16 pixels a byte; the old one has no bound but is not used for more.
  void check_size(const Header& header) const {
    constexpr std::int64_t kAlwaysPlausible = std::int64_t{1} << 24, kPixelsPerByte = 128;
    const std::int64_t pixels = std::int64_t{header.width} * header.height;
    const std::int64_t bytes = static_cast<std::int64_t>(bytes_.size());
    if (std::int64_t{header.height} * 4 > bytes ||
        (pixels > kAlwaysPlausible && pixels / kPixelsPerByte > bytes))
      damaged(fmt::format("{} × {} pixels cannot be in {} bytes", header.width, header.height, bytes));
  }

  static bool is_printable(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= 32 && c < 127; });
  }

  std::uint8_t next() {
    if (position_ >= bytes_.size()) damaged("it is truncated");
    return std::to_integer<std::uint8_t>(bytes_[position_++]);
  }

  Rgbe next_rgbe() { return {next(), next(), next(), next()}; }

  void read_line(std::vector<Rgbe>& line) {
    const int width = static_cast<int>(line.size());
    const Rgbe first = next_rgbe();
    const bool run_length =
        width >= kMinRleWidth && width <= kMaxRleWidth && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!run_length) return read_old_line(line, first);
    if (first[2] * 256 + first[3] != width) damaged("a scan line has another width than the picture");
    for (std::size_t channel = 0; channel < 4; ++channel) read_channel(line, channel);
  }

  void read_channel(std::vector<Rgbe>& line, std::size_t channel) {
    std::size_t x = 0;
    while (x < line.size()) {
      const std::uint8_t code = next();
      const std::size_t count = code > 128 ? code - 128u : code;
      if (count == 0 || count > line.size() - x) damaged("a run leaves its scan line");
      const std::uint8_t value = code > 128 ? next() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) line[x++][channel] = code > 128 ? value : next();
    }
  }

  // Flat pixels; (1, 1, 1, n) repeats the pixel before, consecutive ones count in higher bytes.
  void read_old_line(std::vector<Rgbe>& line, Rgbe pixel) {
    std::size_t x = 0;
    unsigned shift = 0;
    while (true) {
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
        if (x == 0 || shift > 24) damaged("a run has no pixel to repeat");
        const std::size_t count = std::size_t{pixel[3]} << shift;
        if (count > line.size() - x) damaged("a run leaves its scan line");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
        x += count;
        shift += 8;
      } else {
        line[x++] = pixel;
        shift = 0;
      }
      if (x == line.size()) return;
      pixel = next_rgbe();
    }
  }

  static Rgb decode(const Rgbe& p, double scale) {
    if (p[3] == 0) return {};
    const double factor = std::ldexp(scale, int{p[3]} - (128 + 8));
    return {static_cast<float>(p[0] * factor), static_cast<float>(p[1] * factor),
            static_cast<float>(p[2] * factor)};
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
};

}  // namespace

SceneImage parse_radiance_hdr(std::span<const std::byte> bytes, const std::string& name) {
  return Parser(bytes, name).parse();
}

SceneImage read_radiance_hdr(const std::filesystem::path& path) {
  return parse_radiance_hdr(read_bytes(path, kMaxFileBytes), path.string());
}

namespace {

constexpr float kLargestRgbe = 1.7e38f;

Rgbe encode(Rgb c) {
  const float largest = std::max({c.r, c.g, c.b});
  int exponent = 0;
  // Rounding to the nearest mantissa may carry the largest value over 255: then the next exponent is needed.
  std::frexp(largest, &exponent);
  if (std::nearbyint(std::ldexp(double{largest}, 8 - exponent)) > 255) ++exponent;
  if (largest <= 0 || exponent < -127) return {0, 0, 0, 0};
  const auto mantissa = [exponent](float v) {
    return static_cast<std::uint8_t>(std::nearbyint(std::ldexp(double{v}, 8 - exponent)));
  };
  return {mantissa(c.r), mantissa(c.g), mantissa(c.b), static_cast<std::uint8_t>(exponent + 128)};
}

std::size_t run_at(const std::vector<Rgbe>& line, std::size_t x, std::size_t channel) {
  std::size_t length = 1;
  while (length < 127 && x + length < line.size() && line[x + length][channel] == line[x][channel]) ++length;
  return length;
}

void append_channel(std::vector<std::byte>& out, const std::vector<Rgbe>& line, std::size_t channel) {
  constexpr std::size_t kWorthwhileRun = 3, kLongestLiteral = 128;
  std::size_t x = 0;
  while (x < line.size()) {
    const std::size_t run = run_at(line, x, channel);
    if (run >= kWorthwhileRun) {
      out.push_back(static_cast<std::byte>(128 + run));
      out.push_back(static_cast<std::byte>(line[x][channel]));
      x += run;
      continue;
    }
    std::size_t end = x + 1;
    while (end < line.size() && end - x < kLongestLiteral && run_at(line, end, channel) < kWorthwhileRun)
      ++end;
    out.push_back(static_cast<std::byte>(end - x));
    for (; x < end; ++x) out.push_back(static_cast<std::byte>(line[x][channel]));
  }
}

void append_line(std::vector<std::byte>& out, const std::vector<Rgbe>& line) {
  const int width = static_cast<int>(line.size());
  if (width < kMinRleWidth || width > kMaxRleWidth) {
    for (const Rgbe& p : line)
      for (const std::uint8_t v : p) out.push_back(static_cast<std::byte>(v));
    return;
  }
  out.insert(out.end(), {std::byte{2}, std::byte{2}, static_cast<std::byte>(width / 256),
                         static_cast<std::byte>(width % 256)});
  for (std::size_t channel = 0; channel < 4; ++channel) append_channel(out, line, channel);
}

void check_encodable(const SceneImage& image, const std::string& path) {
  if (image.empty()) throw InputError(fmt::format("cannot write {}: the image has no pixels", path));
  if (const auto bad = find_value(image, [](float v) { return !(v >= 0 && v <= kLargestRgbe); }))
    throw InputError(
        fmt::format("cannot write {}: RGBE cannot hold the value {} at pixel ({}, {}): repair "
                    "the image or write .exr",
                    path, bad->value, bad->x, bad->y));
}

}  // namespace

void write_radiance_hdr(const std::filesystem::path& path, const SceneImage& image) {
  check_encodable(image, path.string());
  const std::string header =
      fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height(), image.width());
  const auto* begin = reinterpret_cast<const std::byte*>(header.data());
  std::vector<std::byte> out(begin, begin + header.size());
  std::vector<Rgbe> line(static_cast<std::size_t>(image.width()));
  for (int y = 0; y < image.height(); ++y) {
    std::transform(image.row(y), image.row(y) + image.width(), line.begin(), [](Rgb c) { return encode(c); });
    append_line(out, line);
  }
  write_atomically(path, [&](const std::filesystem::path& temporary) { write_bytes(temporary, out); });
}

}  // namespace plenolab
