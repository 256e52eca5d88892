#include "core/lut/cube_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/bytes.h"
#include "core/io/image_file.h"
#include "core/lut/strip_file.h"

namespace plenolab {

namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;
/// "0 0 0" and a line break: no line of a node is shorter.
constexpr std::size_t kShortestNode = 6;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t start = text.find_first_not_of(kBlank);
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(kBlank) - start + 1);
}

/// Takes the first word off `rest`.
std::string_view next_word(std::string_view& rest) {
  rest = trimmed(rest);
  const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
  const std::string_view word = rest.substr(0, end);
  rest.remove_prefix(end);
  return word;
}

class CubeParser {
 public:
  CubeParser(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  }

  Lut parse() {
    if (text_.find('\0') != std::string_view::npos) fail_file("is no text");
    while (!text_.empty()) {
      ++line_;
      const std::size_t end = text_.find('\n');
      const std::string_view content = trimmed(text_.substr(0, end));
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
      if (!content.empty() && content.front() != '#') parse_line(content);
    }
    finish();
    return std::move(lut_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", name_, line_, what));
  }
  [[noreturn]] void fail_file(const std::string& what) const {
    throw InputError(fmt::format("{} {}", name_, what));
  }

  float number(std::string_view word) const {
    std::string_view digits = word;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    float value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range) return rounded_number(digits);
    if (digits.empty() || digits.front() == '+' || error != std::errc() ||
        end != digits.data() + digits.size())
      fail(fmt::format("'{}' is no number", shown(word)));
    if (!std::isfinite(value)) fail(fmt::format("'{}' is not finite", shown(word)));
    return value;
  }

  /// Of a number beyond the range of float: 0 if it is too small, otherwise an error.
  float rounded_number(std::string_view digits) const {
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || std::abs(value) > 1)
      fail(fmt::format("'{}' does not fit a 32-bit number", shown(digits)));
    return static_cast<float>(value);
  }

  static std::string shown(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    return text;
  }

  template <std::size_t kCount>
  std::array<float, kCount> numbers(std::string_view rest, std::string_view what) const {
    std::array<float, kCount> values{};
    for (float& value : values) {
      const std::string_view word = next_word(rest);
      if (word.empty()) fail(fmt::format("{} needs {} numbers", what, kCount));
      value = number(word);
    }
    if (!trimmed(rest).empty()) fail(fmt::format("{} has more than {} numbers", what, kCount));
    return values;
  }

  void parse_line(std::string_view content) {
    const char first = content.front();
    if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.') {
      parse_node(content);
      return;
    }
    std::string_view rest = content;
    const std::string_view keyword = next_word(rest);
    if (!lut_.nodes.empty()) fail(fmt::format("'{}' stands behind the first node", shown(keyword)));
    parse_keyword(keyword, rest);
  }

  void parse_keyword(std::string_view keyword, std::string_view rest) {
    if (keyword == "TITLE") {
      parse_title(trimmed(rest));
    } else if (keyword == "LUT_3D_SIZE") {
      parse_size(trimmed(rest));
    } else if (keyword == "DOMAIN_MIN" || keyword == "DOMAIN_MAX") {
      const auto [r, g, b] = numbers<3>(rest, keyword);
      (keyword == "DOMAIN_MIN" ? lut_.domain_min : lut_.domain_max) = {r, g, b};
    } else if (keyword == "LUT_3D_INPUT_RANGE") {
      const auto [low, high] = numbers<2>(rest, keyword);
      lut_.domain_min = {low, low, low};
      lut_.domain_max = {high, high, high};
    } else if (keyword == "LUT_1D_SIZE") {
      fail("the table is one-dimensional (LUT_1D_SIZE); only three-dimensional ones (LUT_3D_SIZE) are read");
    } else {
      fail(fmt::format("'{}' is no keyword of a .cube file that is understood", shown(keyword)));
    }
  }

  void parse_title(std::string_view quoted) {
    if (quoted.size() < 2 || quoted.front() != '"' || quoted.back() != '"')
      fail("TITLE needs a text in quotes");
    lut_.title = quoted.substr(1, quoted.size() - 2);
    if (lut_.title.find('"') != std::string::npos) fail("the title holds a quote");
  }

  void parse_size(std::string_view word) {
    if (has_size_) fail("LUT_3D_SIZE stands there twice");
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), lut_.size);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
        lut_.size < kSmallestLut || lut_.size > kLargestLut)
      fail(fmt::format("LUT_3D_SIZE is '{}' and must be a whole number of {} to {}", shown(word),
                       kSmallestLut, kLargestLut));
    has_size_ = true;
    if (text_.size() + 1 < nodes_wanted() * kShortestNode)
      fail_file(fmt::format("is cut off: {} bytes cannot hold the {} nodes of LUT_3D_SIZE {}", text_.size(),
                            nodes_wanted(), lut_.size));
  }

  void parse_node(std::string_view content) {
    if (!has_size_) fail("a node stands before LUT_3D_SIZE");
    if (lut_.nodes.size() == nodes_wanted())
      fail(fmt::format("there are more than the {} nodes of LUT_3D_SIZE {}", nodes_wanted(), lut_.size));
    if (lut_.nodes.empty()) lut_.nodes.reserve(nodes_wanted());
    const auto [r, g, b] = numbers<3>(content, "a node");
    lut_.nodes.push_back({r, g, b});
  }

  void finish() const {
    if (!has_size_) fail_file("has no LUT_3D_SIZE: it is no .cube file");
    if (lut_.nodes.size() != nodes_wanted())
      fail_file(fmt::format("is cut off: it holds {} of the {} nodes of LUT_3D_SIZE {}", lut_.nodes.size(),
                            nodes_wanted(), lut_.size));
    if (!(lut_.domain_min.r < lut_.domain_max.r && lut_.domain_min.g < lut_.domain_max.g &&
          lut_.domain_min.b < lut_.domain_max.b))
      fail_file("has a domain whose minimum does not lie below its maximum");
  }

  std::size_t nodes_wanted() const {
    const auto n = static_cast<std::size_t>(lut_.size);
    return n * n * n;
  }

  std::string_view text_;
  const std::string& name_;
  int line_ = 0;
  bool has_size_ = false;
  Lut lut_;
};

void append_numbers(std::string& text, Rgb c) {
  fmt::format_to(std::back_inserter(text), "{} {} {}\n", c.r, c.g, c.b);
}

}  // namespace

Lut parse_cube(std::string_view text, const std::string& name) {
  return CubeParser(text, name).parse();
}

std::string cube_text(const Lut& lut) {
  lut.validate();
  if (lut.title.find_first_of("\"\r\n") != std::string::npos)
    throw InputError("the title of a look-up table holds a quote or a line break");
  std::string text;
  text.reserve(lut.nodes.size() * 30);
  if (!lut.title.empty()) text += fmt::format("TITLE \"{}\"\n", lut.title);
  text += fmt::format("LUT_3D_SIZE {}\n", lut.size);
  if (lut.domain_min != Rgb{0, 0, 0} || lut.domain_max != Rgb{1, 1, 1}) {
    text += "DOMAIN_MIN ";
    append_numbers(text, lut.domain_min);
    text += "DOMAIN_MAX ";
    append_numbers(text, lut.domain_max);
  }
  for (const Rgb& node : lut.nodes) append_numbers(text, node);
  return text;
}

Lut read_lut(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".cube") return parse_cube(read_text_file(path, kLargestFile), path.string());
  if (extension == ".png") return lut_of_strip(read_display_image(path), path.string());
  throw InputError(fmt::format("{} is no look-up table: give a .cube file or a .png strip", path.string()));
}

void write_lut(const std::filesystem::path& path, const Lut& lut) {
  const std::string extension = lower_extension(path);
  if (extension == ".cube")
    write_text_file(path, cube_text(lut));
  else if (extension == ".png")
    write_display_image(path, strip_of_lut(lut), PngDepth::k16Bit);
  else
    throw InputError(fmt::format("{}: look-up tables are written as .cube or .png", path.string()));
}

}  // namespace plenolab
