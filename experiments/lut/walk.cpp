#include "experiments/walk.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <tuple>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/lut/cube_file.h"
#include "core/lut/grade.h"
#include "core/lut/volume_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/lut/lut.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Of a frame: 8K.
constexpr int kMostPixels = 7680 * 4320;

struct WalkOptions {
  CommonOptions common;
  std::string out;
  int width = 480, height = 270;
  double density = 0.34;
  bool force = false;
};

/// The tables of the walk's places, made from the frames that show most of each; the background's last.
struct WalkTables {
  std::vector<Lut> volumes;
  Lut background;
};

/// Frames are rendered when they are needed and not kept: looking for those that show most of each place
/// takes their depth alone.
WalkTables make_tables(const WalkStage& stage, const std::vector<WalkPose>& path,
                       const WalkOptions& options) {
  const int threads = options.common.threads;
  std::vector<VolumeCounts> counts;
  for (const WalkPose& pose : path)
    counts.push_back(count_pixels(stage.surfaces(pose, options.width, options.height, threads).depth_m,
                                  pose.camera, stage.volumes(), {1, threads}));
  const std::vector<WalkLook> looks = make_walk_looks(
      counts,
      [&](std::size_t i) { return stage.frame(path[i], options.width, options.height, threads).picture; },
      options.common.seed);
  WalkTables tables;
  for (std::size_t v = 0; v + 1 < looks.size(); ++v) tables.volumes.push_back(looks[v].transfer.lut);
  tables.background = looks.back().transfer.lut;
  return tables;
}

void write_scene(const fs::path& folder, const WalkStage& stage, const WalkTables& tables) {
  VolumeScene scene{stage.volumes(), {}, "background.cube"};
  for (std::size_t v = 0; v < tables.volumes.size(); ++v) {
    scene.tables.push_back(fmt::format("volume-{}.cube", v + 1));
    write_lut(folder / scene.tables.back(), tables.volumes[v]);
  }
  write_lut(folder / scene.background, tables.background);
  write_text_file(folder / "volumes.json", volumes_text(scene));
}

/// What `lut frame` needs to be told of a frame's camera.
void add_camera_rows(ResultTable& table, const DepthCamera& camera, std::size_t number) {
  const decltype(ResultRow::columns) columns{{"frame", static_cast<long long>(number)}};
  for (const auto& [name, vector, unit] :
       {std::tuple("camera", &camera.position_m, "m"), std::tuple("forward", &camera.forward, "1"),
        std::tuple("up", &camera.up, "1")})
    for (std::size_t k = 0; k < 3; ++k)
      table.add({fmt::format("{}_{}", name, "xyz"[k]), (*vector)[k], unit, columns});
  table.add({"fov_h", camera.fov_h_deg, "deg", columns});
}

void add_weight_rows(ResultTable& table, const VolumeWeights& weights, std::size_t number,
                     const std::string& method, const WalkStage& stage) {
  const auto add = [&](const std::string& volume, double weight) {
    table.add({"blend_weight",
               weight,
               "1",
               {{"frame", static_cast<long long>(number)}, {"method", method}, {"volume", volume}}});
  };
  for (std::size_t v = 0; v < weights.volumes.size(); ++v) add(stage.volumes()[v].name, weights.volumes[v]);
  add("(background)", weights.background);
}

void write_frame(const fs::path& folder, const WalkFrame& frame, std::size_t number, const WalkStage& stage,
                 const WalkTables& tables, int threads, ResultTable& table) {
  const std::string stem = fmt::format("frame-{:03}", number);
  write_display_image(folder / (stem + ".png"), frame.picture);
  write_exr(folder / (stem + ".exr"), frame.radiance, {{"depth", &frame.depth_m}});
  add_camera_rows(table, frame.pose.camera, number);
  const std::vector<Volume>& volumes = stage.volumes();
  const VolumeWeights linear = linear_weights(volumes, frame.pose.camera.position_m),
                      pixel = pixel_weights(
                          count_pixels(frame.depth_m, frame.pose.camera, volumes, {1, threads}), volumes);
  for (const auto& [method, weights] :
       {std::pair<std::string, const VolumeWeights&>{"linear", linear}, {"pixel", pixel}}) {
    const PreparedLut lut(blend_volumes(weights, tables.volumes, tables.background));
    write_display_image(folder / fmt::format("{}-{}.png", stem, method),
                        lut.grade(frame.picture, {.threads = threads}).image);
    add_weight_rows(table, weights, number, method, stage);
  }
}

void run_walk(const Invocation& invocation, const WalkOptions& options) {
  if (options.width * options.height > kMostPixels)
    throw UsageError(fmt::format("--width {} --height {}: frames have at most {} pixels", options.width,
                                 options.height, kMostPixels));
  Provenance provenance = begin_run(invocation, options.common);
  const WalkStage stage;
  const int threads = options.common.threads;
  const std::vector<WalkPose> path = walk_path(options.density);
  ResultTable table;
  write_result_folder({options.out, "lut-walk", "walk", options.force}, provenance,
                      [&](const fs::path& folder) {
                        ProgressBar bar("walk");
                        const WalkTables tables = make_tables(stage, path, options);
                        write_scene(folder, stage, tables);
                        for (std::size_t i = 0; i < path.size(); ++i) {
                          write_frame(folder, stage.frame(path[i], options.width, options.height, threads), i,
                                      stage, tables, threads, table);
                          bar.callback()(static_cast<double>(i + 1) / static_cast<double>(path.size()));
                        }
                        write_text_file(folder / "rows.csv", to_csv(table));
                      });
  emit_results(table, provenance, options.common);
  tell(options.common, fmt::format("wrote {} frames, their cameras and weights (rows.csv), tables and "
                                   "volumes.json to {}",
                                   path.size(), options.out));
}

}  // namespace

void add_lut_walk(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<WalkOptions>();
  app.add_option("-o,--out", options->out, "Folder for frames, depth, tables and volumes.json")
      ->required()
      ->check(not_empty());
  app.add_option("--width", options->width, "Pixels across")
      ->capture_default_str()
      ->check(whole_number(16, 8192));
  app.add_option("--height", options->height, "Pixels down")
      ->capture_default_str()
      ->check(whole_number(9, 8192));
  app.add_option("--density", options->density, "1: 41 frames; 10: ten times as many steps")
      ->capture_default_str()
      ->check(number_between(0.01, 10));
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut walk -o results/walk");
  app.callback([options, &invocation] { run_walk(invocation, *options); });
}

}  // namespace plenolab
