#include "experiments/lut/picture.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/io/bytes.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/grade_chain.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

/// What the first chunk of a .png says, which the reader has checked to be there.
constexpr std::size_t kBitDepth = 24, kColourType = 25, kHeaderBytes = 26;
constexpr int kGreyAlpha = 4, kColourAlpha = 6;

PngDepth depth_for(const PictureFile& picture, const GradingOptions& options) {
  if (options.bits == "16") return PngDepth::k16Bit;
  return options.bits == "8" ? PngDepth::k8Bit : picture.depth;
}

}  // namespace

void add_grading_options(CLI::App& app, GradingOptions& options) {
  add_interpolation_option(app, options.interpolation);
  app.add_option("--bits", options.bits, "Bits per channel of the result (default: as the picture)")
      ->check(one_of({"8", "16"}));
}

PictureFile read_picture(const std::string& path, Provenance& provenance) {
  if (!is_display_file(path))
    throw InputError(
        fmt::format("{} is scene-referred, but look-up tables grade encoded pictures: tone map it first "
                    "(plenolab tonemap)",
                    path));
  PictureFile picture{read_display_image(path)};
  add_input(provenance, path);
  const std::vector<std::byte> header = read_beginning(path, kHeaderBytes);
  if (std::to_integer<int>(header.at(kBitDepth)) == 16) picture.depth = PngDepth::k16Bit;
  const int type = std::to_integer<int>(header.at(kColourType));
  picture.has_alpha = type == kGreyAlpha || type == kColourAlpha;
  return picture;
}

GradedPicture grade_picture(const PictureFile& picture, const PreparedLut& lut, const GradingOptions& options,
                            int threads) {
  const Stopwatch watch;
  GradedImage graded = lut.grade(picture.image, {interpolation_of(options.interpolation), threads});
  return {std::move(graded), depth_for(picture, options), watch.seconds()};
}

GradedPicture grade_picture(const PictureFile& picture, const CubeContent& content,
                            const GradingOptions& options, int threads) {
  const LutInterpolation interpolation = interpolation_of(options.interpolation);
  const Stopwatch watch;
  GradedImage graded{evaluate_chain(
      picture.image, [&](Rgb c) { return sample_content(content, c, interpolation); }, threads)};
  graded.cut = cut_all_to_unit(graded.image.pixels());
  return {std::move(graded), depth_for(picture, options), watch.seconds()};
}

void add_grading_rows(ResultTable& table, const PictureFile& picture, const GradedPicture& graded,
                      const decltype(ResultRow::columns)& columns) {
  table.add({"values_cut", static_cast<double>(graded.graded.cut), "channel values", columns});
  table.add({"seconds_grade", graded.seconds, "s", columns});
  if (picture.has_alpha)
    table.add({kNoteQuantity,
               0,
               "1",
               {{"note", std::string("the picture's transparency is not graded and not kept")}}});
}

}  // namespace plenolab
