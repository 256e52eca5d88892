#include "core/lut/cube_file.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
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
/// Of one-dimensional tables (Adobe, Cube LUT Specification 1.0).
constexpr int kLargestCurves = 65536;

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

  CubeContent parse() {
    if (text_.find('\0') != std::string_view::npos) fail_file("is no text");
    while (!text_.empty()) {
      ++line_;
      const std::size_t end = text_.find('\n');
      const std::string_view content = trimmed(text_.substr(0, end));
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
      if (!content.empty() && content.front() != '#') parse_line(content);
    }
    finish();
    CubeContent content{{}, {}, title_};
    if (curves_.wanted > 0) content.curves = LutCurves{curves_.low, curves_.high, std::move(curves_.nodes)};
    if (lattice_.wanted > 0)
      content.lattice = Lut{lattice_.size, lattice_.low, lattice_.high, std::move(lattice_.nodes), title_};
    return content;
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
    const bool two_signs = word.starts_with('+') && digits.find_first_of("+-") == 0;
    if (digits.empty() || two_signs || end != digits.data() + digits.size())
      fail(fmt::format("'{}' is no number", shown(word)));
    if (!std::isfinite(value)) fail(fmt::format("'{}' is not finite", shown(word)));
    // Of numbers beyond 32 bits the small ones are 0.
    const double exact = error == std::errc() ? value : std::strtod(std::string(digits).c_str(), nullptr);
    if (std::abs(exact) > kLargestLutNumber)
      fail(fmt::format("'{}' does not lie within ±{:g}", shown(word), kLargestLutNumber));
    return static_cast<float>(exact);
  }

  static std::string shown(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    return text;
  }

  /// What programs write for numbers that are none counts: a node that is not finite is told as such.
  static bool looks_like_number(std::string_view word) {
    const char first = word.front();
    if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.') return true;
    std::string lower(word);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower == "nan" || lower == "inf" || lower == "infinity";
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
    std::string_view rest = content;
    const std::string_view keyword = next_word(rest);
    if (looks_like_number(keyword)) {
      parse_node(content);
      return;
    }
    if (!curves_.nodes.empty() || !lattice_.nodes.empty())
      fail(fmt::format("'{}' stands behind the first node", shown(keyword)));
    parse_keyword(keyword, rest);
  }

  void parse_keyword(std::string_view keyword, std::string_view rest) {
    if (keyword == "TITLE") {
      parse_title(trimmed(rest));
    } else if (keyword == "LUT_3D_SIZE") {
      parse_size(lattice_, keyword, trimmed(rest));
    } else if (keyword == "LUT_1D_SIZE") {
      parse_size(curves_, keyword, trimmed(rest));
    } else if (keyword == "DOMAIN_MIN" || keyword == "DOMAIN_MAX") {
      const auto [r, g, b] = numbers<3>(rest, keyword);
      (keyword == "DOMAIN_MIN" ? domain_min_ : domain_max_) = Rgb{r, g, b};
    } else if (keyword == "LUT_3D_INPUT_RANGE" || keyword == "LUT_1D_INPUT_RANGE") {
      const auto [low, high] = numbers<2>(rest, keyword);
      Part& part = keyword == "LUT_3D_INPUT_RANGE" ? lattice_ : curves_;
      part.low = {low, low, low};
      part.high = {high, high, high};
    } else {
      fail(fmt::format("'{}' is no keyword of a .cube file that is understood", shown(keyword)));
    }
  }

  void parse_title(std::string_view quoted) {
    if (quoted.size() < 2 || quoted.front() != '"' || quoted.back() != '"')
      fail("TITLE needs a text in quotes");
    title_ = quoted.substr(1, quoted.size() - 2);
    if (title_.find('"') != std::string::npos) fail("the title holds a quote");
  }

  /// The nodes of a lattice or of curves.
  struct Part {
    int dimensions, largest;
    int size = 0;
    std::size_t wanted = 0;  ///< nodes; 0: the file has none of this kind
    Rgb low{0, 0, 0}, high{1, 1, 1};
    std::vector<Rgb> nodes;
    const char* keyword() const { return dimensions == 3 ? "LUT_3D_SIZE" : "LUT_1D_SIZE"; }
  };

  void parse_size(Part& part, std::string_view keyword, std::string_view word) {
    if (part.wanted > 0) fail(fmt::format("{} stands there twice", keyword));
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), part.size);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
        part.size < kSmallestLut || part.size > part.largest)
      fail(fmt::format("{} is '{}' and must be a whole number of {} to {}", keyword, shown(word),
                       kSmallestLut, part.largest));
    const auto n = static_cast<std::size_t>(part.size);
    part.wanted = part.dimensions == 3 ? n * n * n : n;
    if (text_.size() + 1 < part.wanted * kShortestNode)
      fail_file(fmt::format("is cut off: {} bytes cannot hold the {} nodes of {} {}", text_.size(),
                            part.wanted, keyword, part.size));
  }

  void parse_node(std::string_view content) {
    if (curves_.wanted + lattice_.wanted == 0) fail("a node stands before LUT_3D_SIZE or LUT_1D_SIZE");
    Part& part = curves_.nodes.size() < curves_.wanted ? curves_ : lattice_;
    if (part.nodes.size() == part.wanted) {
      const Part& last = lattice_.wanted > 0 ? lattice_ : curves_;
      fail(fmt::format("there are more than the {} nodes of {} {}", last.wanted, last.keyword(), last.size));
    }
    if (part.nodes.empty()) part.nodes.reserve(part.wanted);
    const auto [r, g, b] = numbers<3>(content, "a node");
    part.nodes.push_back({r, g, b});
  }

  void finish() {
    if (curves_.wanted + lattice_.wanted == 0)
      fail_file("has neither LUT_3D_SIZE nor LUT_1D_SIZE: it is no .cube file");
    Part& first = curves_.wanted > 0 ? curves_ : lattice_;
    if (domain_min_) first.low = *domain_min_;
    if (domain_max_) first.high = *domain_max_;
    for (const Part* part : {&curves_, &lattice_}) {
      if (part->nodes.size() != part->wanted)
        fail_file(fmt::format("is cut off: it holds {} of the {} nodes of {} {}", part->nodes.size(),
                              part->wanted, part->keyword(), part->size));
      const Rgb range = part->high - part->low;
      if (!(std::min({range.r, range.g, range.b}) >= kNarrowestDomain))
        fail_file("has a domain whose minimum does not lie below its maximum");
    }
  }

  std::string_view text_;
  const std::string& name_;
  int line_ = 0;
  Part curves_{1, kLargestCurves}, lattice_{3, kLargestLut};
  std::optional<Rgb> domain_min_, domain_max_;
  std::string title_;
};

void append_numbers(std::string& text, Rgb c) {
  fmt::format_to(std::back_inserter(text), "{} {} {}\n", c.r, c.g, c.b);
}

}  // namespace

CubeContent parse_cube_content(std::string_view text, const std::string& name) {
  return CubeParser(text, name).parse();
}

Rgb sample_content(const CubeContent& content, Rgb colour, LutInterpolation interpolation) {
  const Rgb shaped = content.curves ? (*content.curves)(colour) : colour;
  return content.lattice ? sample_lut(*content.lattice, shaped, interpolation) : shaped;
}

Lut lut_of_content(const CubeContent& content, int size) {
  Lut lut = content.curves
                ? lut_of_curves(*content.curves, content.lattice ? &*content.lattice : nullptr, size)
                : *content.lattice;
  lut.title = content.title;
  return lut;
}

Lut parse_cube(std::string_view text, const std::string& name) {
  return lut_of_content(parse_cube_content(text, name));
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

CubeContent read_cube_content(const std::filesystem::path& path) {
  return parse_cube_content(read_text_file(path, kLargestFile), path.string());
}

Lut read_lut(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".cube") return lut_of_content(read_cube_content(path));
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
