#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/cli/adjustment_options.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/operator_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/synthesis_options.h"
#include "experiments/mapped_frames.h"
#include "experiments/score.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct VideoOptions {
  CommonOptions common;
  SynthesisOptions synthesis;
  std::string folder, path, out;
  std::string format;
  int frames = 60;
  double exposure = 0;
  int memory_mib = 2048;
  bool force = false;
  OperatorOptions chosen;
  KeyViewAdjustmentOptions adjustment;
  std::string map;
  double fps = 30;
  AdaptationOptions adaptation;
  bool adjustment_given = false;
  bool consistency = false;
  std::vector<const CLI::Option*> for_operators;  ///< options that mean nothing without --operator
  const CLI::Option* adaptation_time = nullptr;
};

void write_frames(
    const LightField& field, const std::vector<CameraPosition>& positions, const VideoOptions& options,
    const fs::path& folder,
    const std::function<void(std::size_t, const fs::path&, const NovelView<SceneReferred>&)>& written) {
  const std::string format = options.format.empty() ? "exr" : options.format;
  const bool png = format == "png";
  const std::optional<double> unit = field.unit() == RadianceUnit::kCdM2 ? std::optional(1.0) : std::nullopt;
  const float exposure = png ? common_exposure(field, options.exposure) : 1;
  Synthesizer(field).synthesize_sequence(
      positions, options.synthesis, [&](std::size_t index, NovelView<SceneReferred>&& view) {
        const fs::path file = folder / fmt::format("frame_{:04}.{}", index, format);
        if (png)
          write_display_image(file, expose(view.image, exposure));
        else
          write_scene_image(file, view.image, unit);
        written(index, file, view);
      });
}

void write_frames(
    const DisplayLightField& field, const std::vector<CameraPosition>& positions, const VideoOptions& options,
    const fs::path& folder,
    const std::function<void(std::size_t, const fs::path&, const NovelView<DisplayReferred>&)>& written) {
  DisplaySynthesizer(field).synthesize_sequence(
      positions, options.synthesis, [&](std::size_t index, NovelView<DisplayReferred>&& view) {
        const fs::path file = folder / fmt::format("frame_{:04}.png", index);
        write_display_image(file, view.image);
        written(index, file, view);
      });
}

void require_fitting_format(const AnyLightField& any, const VideoOptions& options) {
  const bool display_referred = std::holds_alternative<DisplayLightField>(any);
  if (display_referred && options.format == "exr")
    throw UsageError(
        "--format exr: the frames of a display-referred light field are written as .png, leave it out");
  if (options.exposure > 0 && (display_referred || options.format != "png"))
    throw UsageError("--exposure is for --format png of a light field with radiance");
}

/// Writes all frames below `folder` and says what each took.
ResultTable make_video(const AnyLightField& any, const std::vector<CameraPosition>& positions,
                       const VideoOptions& options, const fs::path& folder) {
  ResultTable table;
  ProgressBar bar("synthesising");
  const auto record = [&](std::size_t index, const fs::path& file, const auto& view) {
    const Columns columns{{"frame", static_cast<long long>(index)},
                          {"file", file.filename().string()},
                          {"s", view.position.s},
                          {"t", view.position.t}};
    table.add({"unseen_pixels", static_cast<double>(view.unseen_pixels), "px", columns});
    table.add({"seconds_synthesis", view.timings.total_s - view.timings.prepare_s, "s", columns});
    bar.update(static_cast<double>(index + 1) / static_cast<double>(positions.size()));
  };
  std::visit([&](const auto& field) { write_frames(field, positions, options, folder, record); }, any);
  return table;
}

MappingPlace place_of(const VideoOptions& options, const OperatorChoice& choice) {
  if (options.map.empty()) return default_place(choice);
  return options.map == "frames" ? MappingPlace::kFrames : MappingPlace::kKeyViews;
}

MappedVideoOptions mapped_video_options(const VideoOptions& options) {
  const OperatorChoice choice = choose_operator(options.chosen);
  const MappingPlace place = place_of(options, choice);
  require_possible(choice, place);
  if (options.adjustment_given && !choice.adjusted)
    throw UsageError("options of key-view adjustment are for --variant adjusted or VARIANT+adjusted");
  if (options.adaptation_time->count() > 0 && !choice.maps_frames())
    throw UsageError(fmt::format("--adaptation-time: variant {} does not adapt in time; those for frames do",
                                 choice.variant_name()));
  if (options.format == "exr" || options.exposure > 0)
    throw UsageError("--format exr and --exposure are for radiance: with --operator frames are mapped .png");
  return {.mapping = {.choice = choice,
                      .adjustment = options.adjustment,
                      .threads = options.common.threads,
                      .memory_bound_bytes = static_cast<std::size_t>((options.memory_mib + 1) / 2) << 20},
          .place = place,
          .synthesis = options.synthesis,
          .adaptation = options.adaptation,
          .frames_per_second = options.fps};
}

void run_mapped_video(const Invocation& invocation, const VideoOptions& options,
                      const std::vector<CameraPosition>& positions) {
  const MappedVideoOptions mapping = mapped_video_options(options);
  const OperatorChoice& choice = mapping.mapping.choice;
  Provenance provenance = begin_run(invocation, options.common);
  const LightField field = open_radiance(options.folder, (options.memory_mib + 1) / 2);
  add_input(provenance, options.folder);
  provenance.parameters["settings"] = settings_text(choice);
  for (const CameraPosition& position : positions) require_on_grid(position, field.grid(), "--path");
  const std::string item = fmt::format("{} --path {} --operator {} --variant {}", item_path(options.folder),
                                       options.path, choice.info->id, choice.variant_name());
  ResultTable table;
  write_result_folder({options.out, "video", item, options.force}, provenance, [&](const fs::path& folder) {
    table = write_mapped_frames(field, positions, mapping, options.consistency, folder);
  });
  tell(options.common, fmt::format("wrote {} frames and frames.csv to {}", positions.size(), options.out));
  emit_results(table, provenance, options.common);
}

void run_video(const Invocation& invocation, VideoOptions& options) {
  const std::vector<CameraPosition> positions = parse_path(options.path, options.frames);
  require_fitting(options.synthesis);
  options.synthesis.threads = options.common.threads;
  if (!options.chosen.name.empty()) return run_mapped_video(invocation, options, positions);
  for (const CLI::Option* option : options.for_operators)
    if (option->count() > 0)
      throw UsageError(option->get_name() + " is for --operator NAME, which is missing");
  if (options.adjustment_given)
    throw UsageError("options of key-view adjustment are for --operator NAME --variant adjusted");
  Provenance provenance = begin_run(invocation, options.common);
  const AnyLightField any = open_any_light_field(options.folder, options.memory_mib);
  add_input(provenance, options.folder);
  for (const CameraPosition& position : positions) require_on_grid(position, grid_of(any), "--path");
  require_fitting_format(any, options);
  ResultTable table;
  const std::string item = fmt::format("{} --path {}", item_path(options.folder), options.path);
  write_result_folder({options.out, "video", item, options.force}, provenance, [&](const fs::path& folder) {
    table = make_video(any, positions, options, folder);
    write_text_file(folder / "frames.csv", to_csv(table));
  });
  tell(options.common, fmt::format("wrote {} frames to {}", positions.size(), options.out));
  if (!options.common.json.empty() || !options.common.csv.empty())
    emit_results(table, provenance, options.common);
}

/// Options of tone mapped frames.
void add_mapping_options(CLI::App& app, VideoOptions& options) {
  add_operator_options(app, options.chosen);
  app.add_option("--map", options.map,
                 "What the operator maps: key views before synthesis, or frames after it (default: frames by "
                 "variants for frames, else key views)")
      ->check(one_of({"key-views", "frames"}));
  app.add_option("--fps", options.fps, "Frames per second: how far the eye adapts from frame to frame")
      ->check(number_between(0.001, 100000))
      ->capture_default_str();
  options.adaptation_time =
      app.add_option("--adaptation-time", options.adaptation.time_constant_s,
                     "Time constant of adaptation in seconds, of variants for frames; 0 = at once")
          ->check(number_between(0, 1e6))
          ->capture_default_str();
  add_adjustment_options(app, options.adjustment);
  app.add_flag(
      "--consistency", options.consistency,
      "Also measure what tone mapping adds to the changes along epipolar lines, at visibility borders "
      "and of mean luma; synthesises every HDR frame once more");
  for (const char* name : {"--variant", "--set", "--map", "--fps", "--adaptation-time", "--consistency"})
    options.for_operators.push_back(app.get_option(name));
}

}  // namespace

void add_video_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<VideoOptions>();
  app.add_option("folder", options->folder, "Folder of the light field")->required();
  app.add_option("--path", options->path, "Camera path S0,T0:S1,T1[:S2,T2...]")->required();
  app.add_option("--frames", options->frames, "Frames along the path, both ends included")
      ->check(whole_number(1, 100000))
      ->capture_default_str();
  app.add_option("-o,--out", options->out, "Folder for frame_0000.exr, ... and frames.csv")
      ->required()
      ->check(not_empty());
  app.add_option("--format", options->format,
                 "exr keeps radiance (default), png is exposed for display at one exposure (default of "
                 "display-referred light fields)")
      ->check(one_of({"exr", "png"}));
  app.add_option("--exposure", options->exposure, "Exposure of .png frames")->check(positive_number());
  add_mapping_options(app, *options);
  add_memory_option(app, options->memory_mib);
  add_synthesis_options(app, options->synthesis);
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab video results/cellar --path 0,1:4,1 --frames 60 -o frames\n"
      "          plenolab video results/cellar --path 0,1:4,1 --frames 60 --operator reinhard05 --variant "
      "interpolate-statistics --fps 60 -o mapped");
  app.callback([options, &app, &invocation] {
    options->adjustment_given = adjustment_options_given(app);
    run_video(invocation, *options);
  });
}

}  // namespace plenolab
