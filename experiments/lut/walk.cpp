#include "experiments/walk.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

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

WalkTables make_tables(const WalkStage& stage, const std::vector<WalkFrame>& frames,
                       const WalkOptions& options) {
  WalkTables tables;
  for (int look = 0; look < kWalkLooks; ++look) {
    const bool is_background = look == kWalkLooks - 1;
    const WalkFrame& source = frames[frame_that_shows_most(stage, frames, is_background ? -1 : look)];
    Lut lut = make_walk_look(look, source.picture, kDefaultLutSize, options.common.seed).transfer.lut;
    if (is_background)
      tables.background = std::move(lut);
    else
      tables.volumes.push_back(std::move(lut));
  }
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

void add_camera_rows(ResultTable& table, const DepthCamera& camera, std::size_t number) {
  const decltype(ResultRow::columns) columns{{"frame", static_cast<long long>(number)}};
  table.add({"camera_x", camera.position_m[0], "m", columns});
  table.add({"camera_y", camera.position_m[1], "m", columns});
  table.add({"camera_z", camera.position_m[2], "m", columns});
  table.add({"forward_x", camera.forward[0], "1", columns});
  table.add({"forward_y", camera.forward[1], "1", columns});
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
                 const WalkTables& tables, ResultTable& table) {
  const std::string stem = fmt::format("frame-{:02}", number);
  write_display_image(folder / (stem + ".png"), frame.picture);
  write_exr(folder / (stem + ".exr"), frame.radiance, {{"depth", &frame.depth_m}});
  add_camera_rows(table, frame.pose.camera, number);
  const std::vector<Volume>& volumes = stage.volumes();
  const VolumeWeights linear = linear_weights(volumes, frame.pose.camera.position_m),
                      pixel = pixel_weights(count_pixels(frame.depth_m, frame.pose.camera, volumes), volumes);
  for (const auto& [method, weights] :
       {std::pair<std::string, const VolumeWeights&>{"linear", linear}, {"pixel", pixel}}) {
    const PreparedLut lut(blend_volumes(weights, tables.volumes, tables.background));
    write_display_image(folder / fmt::format("{}-{}.png", stem, method), lut.grade(frame.picture).image);
    add_weight_rows(table, weights, number, method, stage);
  }
}

void run_walk(const Invocation& invocation, const WalkOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  const WalkStage stage;
  std::vector<WalkFrame> frames;
  ProgressBar bar("walk");
  const std::vector<WalkPose> path = walk_path(options.density);
  ResultTable table;
  write_result_folder(
      {options.out, "lut-walk", "walk", options.force}, provenance, [&](const fs::path& folder) {
        for (const WalkPose& pose : path) {
          frames.push_back(stage.frame(pose, options.width, options.height, options.common.threads));
          bar.callback()(static_cast<double>(frames.size()) / static_cast<double>(path.size()));
        }
        const WalkTables tables = make_tables(stage, frames, options);
        write_scene(folder, stage, tables);
        for (std::size_t i = 0; i < frames.size(); ++i)
          write_frame(folder, frames[i], i, stage, tables, table);
      });
  emit_results(table, provenance, options.common);
  tell(options.common,
       fmt::format("wrote {} frames, their tables and volumes.json to {}", frames.size(), options.out));
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
  app.add_option("--density", options->density, "1: 41 frames; other densities more or fewer")
      ->capture_default_str()
      ->check(number_between(0.01, 10));
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut walk -o results/walk");
  app.callback([options, &invocation] { run_walk(invocation, *options); });
}

}  // namespace plenolab
