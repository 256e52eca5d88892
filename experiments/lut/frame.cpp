#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/lut/volume_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/result_folder.h"
#include "experiments/lut/camera.h"
#include "experiments/lut/lut.h"
#include "experiments/lut/picture.h"

namespace plenolab {

namespace {

struct FrameOptions {
  CommonOptions common;
  CameraOptions camera;
  GradingOptions grading;
  std::string volumes, depth, channel = "depth", method = "pixel", image, graded, out;
  int stride = 1;
};

/// Options of one method, or of the graded picture, given without it.
void check_given(const CLI::App& app, const FrameOptions& options) {
  const auto refuse = [&](std::initializer_list<const char*> names, const char* reason) {
    for (const char* name : names)
      if (app.count(name) > 0) throw UsageError(fmt::format("{}: {}", name, reason));
  };
  if (options.method == "linear")
    refuse({"--depth", "--channel", "--forward", "--up", "--fov", "--stride"},
           "--method linear goes by where the camera stands (--camera) alone");
  if (options.image.empty()) refuse({"--interpolation", "--bits"}, "there is no --image to grade");
}

void check_together(const FrameOptions& options) {
  if (options.method == "pixel" && options.depth.empty())
    throw UsageError("--method pixel counts what the camera sees: give --depth");
  if (options.image.empty() != options.graded.empty())
    throw UsageError("--image and --graded go together: the frame and where its graded version goes");
  if (!options.graded.empty() && !options.out.empty() && item_path(options.graded) == item_path(options.out))
    throw UsageError(fmt::format("--graded and -o are both {}: one would replace the other", options.out));
}

/// What a frame's table is blended from, and how long finding that out took.
struct FrameWeights {
  VolumeWeights weights;
  std::int64_t pixels = 0;
  int width = 0, height = 0;  ///< of the depth; 0: not looked at
  double seconds = 0;
};

FrameWeights weigh(const FrameOptions& options, const DepthCamera& camera, const std::vector<Volume>& volumes,
                   Provenance& provenance) {
  FrameWeights found;
  if (options.method == "linear") {
    const Stopwatch watch;
    found.weights = linear_weights(volumes, camera.position_m);
    found.seconds = watch.seconds();
    return found;
  }
  const Plane<float> depth = read_exr_channels(options.depth, {options.channel}).front();
  add_input(provenance, options.depth);
  const Stopwatch watch;
  const VolumeCounts counts = count_pixels(depth, camera, volumes, {options.stride, options.common.threads});
  found.weights = pixel_weights(counts, volumes);
  found.seconds = watch.seconds();
  found.pixels = counts.pixels();
  found.width = depth.width();
  found.height = depth.height();
  return found;
}

/// The picture to grade, if one is wanted. Throws InputError if it is not that of the depth.
std::optional<PictureFile> frame_picture(const FrameOptions& options, const FrameWeights& found,
                                         Provenance& provenance) {
  if (options.image.empty()) return std::nullopt;
  PictureFile picture = read_picture(options.image, provenance);
  if (found.width > 0 && (picture.image.width() != found.width || picture.image.height() != found.height))
    throw InputError(fmt::format("{} has {} × {} pixels and {} {} × {}: they are not of one frame",
                                 options.image, picture.image.width(), picture.image.height(), options.depth,
                                 found.width, found.height));
  return picture;
}

/// Writes both files or neither.
void write_outputs(const FrameOptions& options, const Lut& lut, const GradedPicture* graded,
                   Provenance& provenance) {
  if (!options.out.empty()) require_lut_output(options.out, lut, provenance);
  const auto write_table = [&] {
    if (!options.out.empty()) write_lut_output(options.out, lut, provenance, options.common);
  };
  if (!graded) return write_table();
  require_keeps_inputs(provenance, options.graded);
  write_atomically(options.graded, [&](const std::filesystem::path& temporary) {
    write_display_image(temporary, graded->graded.image, graded->depth);
    write_table();
  });
  write_run_json_beside(options.graded, provenance);
  tell(options.common, fmt::format("wrote {}", options.graded));
}

void add_weight_rows(ResultTable& table, const FrameWeights& found, const std::vector<Volume>& volumes) {
  for (std::size_t i = 0; i < volumes.size(); ++i)
    table.add({"blend_weight", found.weights.volumes[i], "1", {{"volume", volumes[i].name}}});
  table.add({"blend_weight", found.weights.background, "1", {{"volume", std::string("(background)")}}});
  if (found.pixels > 0) table.add({"pixels_counted", static_cast<double>(found.pixels), "px", {}});
  table.add({"seconds_weights", found.seconds, "s", {}});
}

void run_frame(const Invocation& invocation, const FrameOptions& options) {
  check_together(options);
  const DepthCamera camera = camera_of(options.camera);
  Provenance provenance = begin_run(invocation, options.common);
  const LoadedVolumes scene = read_volumes(options.volumes);
  add_input(provenance, options.volumes);
  for (const auto& file : scene.files) add_input(provenance, file);
  const FrameWeights found = weigh(options, camera, scene.volumes, provenance);
  const Lut lut = blend_volumes(found.weights, scene.tables, scene.background);
  const std::optional<PictureFile> picture = frame_picture(options, found, provenance);
  std::optional<GradedPicture> graded;
  if (picture) graded = grade_picture(*picture, PreparedLut(lut), options.grading, options.common.threads);
  write_outputs(options, lut, graded ? &*graded : nullptr, provenance);
  ResultTable table;
  add_weight_rows(table, found, scene.volumes);
  if (graded) add_grading_rows(table, *picture, *graded, {{"image", options.image}});
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_frame(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<FrameOptions>();
  app.add_option("volumes", options->volumes, "Volumes and their tables (.json, see core/README.md)")
      ->required();
  app.add_option("--method", options->method,
                 "pixel: by what the camera sees; linear: by where it stands, as game engines do")
      ->capture_default_str()
      ->check(one_of({"pixel", "linear"}));
  app.add_option("--depth", options->depth, "Planar depth of the frame in metres, inf for nothing (.exr)");
  app.add_option("--channel", options->channel, "Channel of --depth")->capture_default_str();
  add_camera_options(app, options->camera);
  app.add_option("--stride", options->stride, "Count every n-th pixel of every n-th row")
      ->capture_default_str()
      ->check(whole_number(1, 65536));
  app.add_option("--image", options->image, "Frame to grade (.png)");
  app.add_option("--graded", options->graded, "Graded frame (.png)")->check(file_ending_in({".png"}));
  add_grading_options(app, options->grading);
  app.add_option("-o,--out", options->out, "Blended table to write: .cube or .png")
      ->check(file_ending_in({".cube", ".png"}));
  add_common_options(app, options->common);
  app.footer(
      "Example: plenolab lut frame volumes.json --depth frame.exr --camera 0,-3,1.6 --forward 0,1,0 "
      "--image frame.png --graded graded.png");
  app.callback([options, &invocation, &app] {
    check_given(app, *options);
    run_frame(invocation, *options);
  });
}

}  // namespace plenolab
