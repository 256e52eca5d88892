#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/lut/grade.h"
#include "core/lut/volume_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/result_folder.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct FrameOptions {
  CommonOptions common;
  std::string volumes, depth, channel = "depth", method = "pixel", image, graded, out;
  std::vector<double> position{0, 0, 0}, forward{0, 1, 0}, up{0, 0, 1};
  double fov_h_deg = 60;
  int stride = 1;
};

Point3 point_of(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Point3 unit(const std::vector<double>& numbers, const char* option) {
  const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
  if (!(length > 0)) throw UsageError(fmt::format("{}: the direction has no length", option));
  return {numbers[0] / length, numbers[1] / length, numbers[2] / length};
}

DepthCamera camera_of(const FrameOptions& options) {
  return {point_of(options.position), unit(options.forward, "--forward"), unit(options.up, "--up"),
          options.fov_h_deg};
}

void check_together(const FrameOptions& options) {
  if (options.method == "pixel" && options.depth.empty())
    throw UsageError("--method pixel counts what the camera sees: give --depth");
  if (options.image.empty() != options.graded.empty())
    throw UsageError("--image and --graded go together: the frame and where its graded version goes");
}

/// What a frame's table is blended from, and how long finding that out took.
struct FrameWeights {
  VolumeWeights weights;
  std::int64_t pixels = 0;
  double seconds = 0;
};

FrameWeights weigh(const FrameOptions& options, const std::vector<Volume>& volumes, Provenance& provenance) {
  const DepthCamera camera = camera_of(options);
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
  return found;
}

void grade_frame(const FrameOptions& options, const Lut& lut, Provenance& provenance) {
  if (options.image.empty()) return;
  const DisplayImage image = read_display_image(options.image);
  add_input(provenance, options.image);
  require_keeps_inputs(provenance, options.graded);
  write_display_image(options.graded,
                      PreparedLut(lut).grade(image, {.threads = options.common.threads}).image);
  tell(options.common, fmt::format("wrote {}", options.graded));
}

void run_frame(const Invocation& invocation, const FrameOptions& options) {
  check_together(options);
  Provenance provenance = begin_run(invocation, options.common);
  const LoadedVolumes scene = read_volumes(options.volumes);
  add_input(provenance, options.volumes);
  for (const auto& file : scene.files) add_input(provenance, file);
  const FrameWeights found = weigh(options, scene.volumes, provenance);
  const Lut lut = blend_volumes(found.weights, scene.tables, scene.background);
  grade_frame(options, lut, provenance);
  if (!options.out.empty()) write_lut_output(options.out, lut, provenance, options.common);
  ResultTable table;
  for (std::size_t i = 0; i < scene.volumes.size(); ++i)
    table.add({"blend_weight", found.weights.volumes[i], "1", {{"volume", scene.volumes[i].name}}});
  table.add({"blend_weight", found.weights.background, "1", {{"volume", std::string("(background)")}}});
  if (found.pixels > 0) table.add({"pixels_counted", static_cast<double>(found.pixels), "px", {}});
  table.add({"seconds_weights", found.seconds, "s", {}});
  emit_results(table, provenance, options.common);
}

void add_camera_options(CLI::App& app, FrameOptions& options) {
  const auto add_point = [&](const char* name, std::vector<double>& point, const char* help) {
    app.add_option(name, point, help)->delimiter(',')->expected(3)->capture_default_str();
  };
  add_point("--camera", options.position, "Position of the camera as X,Y,Z in metres");
  add_point("--forward", options.forward, "Where it looks, as X,Y,Z of any length");
  add_point("--up", options.up, "At a right angle to that");
  app.add_option("--fov", options.fov_h_deg, "Full horizontal opening angle in degrees")
      ->capture_default_str()
      ->check(number_between(0.01, 179.99));
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
  add_camera_options(app, *options);
  app.add_option("--stride", options->stride, "Count every n-th pixel of every n-th row")
      ->capture_default_str()
      ->check(whole_number(1, 65536));
  app.add_option("--image", options->image, "Frame to grade (.png)");
  app.add_option("--graded", options->graded, "Graded frame (.png)")->check(file_ending_in({".png"}));
  app.add_option("-o,--out", options->out, "Blended table to write: .cube or .png")
      ->check(file_ending_in({".cube", ".png"}));
  add_common_options(app, options->common);
  app.footer(
      "Example: plenolab lut frame volumes.json --depth frame.exr --camera 0,-3,1.6 --forward 0,1,0 "
      "--image frame.png --graded graded.png");
  app.callback([options, &invocation] { run_frame(invocation, *options); });
}

}  // namespace plenolab
