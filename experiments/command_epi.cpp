#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/epi.h"
#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"

namespace plenolab {

namespace {

constexpr int kLargestLine = 1 << 20;

struct EpiOptions {
  CommonOptions common;
  std::string frames, out;
  int row = -1, column = -1;
  int stretch = 1;
  double exposure = 0;
};

template <class Image>
std::vector<Image> read_frames(const std::vector<std::filesystem::path>& files) {
  std::vector<Image> frames;
  for (const auto& file : files) {
    AnyImage image = read_any_image(file);
    if (!std::holds_alternative<Image>(image))
      throw InputError(fmt::format("{} and {} are not of one kind: give a folder of one kind of frames",
                                   files.front().string(), file.string()));
    frames.push_back(std::move(std::get<Image>(image)));
  }
  return frames;
}

/// Throws if the line to cut along is not in the frames.
template <class Image>
void require_line(const Image& frame, EpiDirection direction, int line) {
  const bool row = direction == EpiDirection::kRow;
  const int lines = row ? frame.height() : frame.width();
  if (line >= lines)
    throw UsageError(fmt::format("--{}: give a whole number from 0 to {}, the last of the frames, not '{}'",
                                 row ? "row" : "column", lines - 1, line));
}

template <class Image>
Image cut_frames(const std::vector<std::filesystem::path>& files, EpiDirection direction, int line) {
  const std::vector<Image> frames = read_frames<Image>(files);
  require_line(frames.front(), direction, line);
  return epi(frames, direction, line);
}

/// The slice as a display image; scene-referred frames at one exposure for all.
DisplayImage cut(const std::vector<std::filesystem::path>& files, EpiDirection direction, int line,
                 const EpiOptions& options) {
  if (is_display_file(files.front())) return cut_frames<DisplayImage>(files, direction, line);
  const SceneImage slice = cut_frames<SceneImage>(files, direction, line);
  if (!is_display_file(options.out)) {
    write_scene_image(options.out, slice);
    return {};
  }
  return expose(slice, options.exposure > 0 ? static_cast<float>(options.exposure) : exposure_from(slice));
}

void run_epi(const Invocation& invocation, const EpiOptions& options) {
  if ((options.row < 0) == (options.column < 0)) throw UsageError("give either --row Y or --column X");
  if (options.stretch > 1 && !is_display_file(options.out))
    throw UsageError("--stretch is for looking at a .png: leave it out for files that keep radiance");
  const auto files = image_files(options.frames);
  const bool display_frames = is_display_file(files.front());
  if (display_frames && !is_display_file(options.out))
    throw UsageError(fmt::format(
        "--out: give a name that ends in .png, not '{}': the frames hold no radiance", options.out));
  if (options.exposure > 0 && (display_frames || !is_display_file(options.out)))
    throw UsageError("--exposure is for a .png of frames with radiance");
  const EpiDirection direction = options.row >= 0 ? EpiDirection::kRow : EpiDirection::kColumn;
  Provenance provenance = begin_run(invocation, options.common);
  add_input(provenance, options.frames);
  const DisplayImage slice = cut(files, direction, std::max(options.row, options.column), options);
  if (!slice.empty()) write_display_image(options.out, stretch_epi(slice, direction, options.stretch));
  write_run_json_beside(options.out, provenance);
  tell(options.common, fmt::format("wrote {}", options.out));
  ResultTable table;
  table.add({"frames", static_cast<double>(files.size()), "frames", {{"path", options.out}}});
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_epi_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<EpiOptions>();
  app.add_option("frames", options->frames, "Folder of frames, taken in order of their names")->required();
  app.add_option("-o,--out", options->out,
                 "Image to write; .png is exposed for display, .exr .hdr .pfm keep radiance")
      ->required()
      ->check(file_ending_in({".png", ".exr", ".hdr", ".pfm"}));
  app.add_option("--row", options->row, "Cut along this row (horizontal camera motion)")
      ->check(whole_number(0, kLargestLine));
  app.add_option("--column", options->column, "Cut along this column (vertical camera motion)")
      ->check(whole_number(0, kLargestLine));
  app.add_option("--stretch", options->stretch, "Repeat each frame this often in a .png")
      ->check(whole_number(1, 64));
  app.add_option("--exposure", options->exposure, "Exposure of a .png (default: 99th percentile becomes 1)")
      ->check(positive_number());
  add_common_options(app, options->common);
  app.footer("Example: plenolab epi frames --row 135 -o epi.png");
  app.callback([options, &invocation] { run_epi(invocation, *options); });
}

}  // namespace plenolab
