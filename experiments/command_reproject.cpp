#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/display/retina.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/scenes.h"
#include "experiments/near_eye.h"
#include "experiments/score.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct ReprojectOptions {
  CommonOptions common;
  std::string source, out, method = "two-step", holes = "mean", optics = "thesis", eye;
  int cameras = 4, supersampling = 2;
  double focus_m = 1, pupil_mm = 4, stereo_mm = 0;
  bool compare = false, image_set = false, force = false;
};

/// A light field that is being made, at the size it is rendered at.
struct Made {
  DisplayImage light_field;
  SubimageLayout layout;
  int supersampling = 1;
  NearEyeDisplay display;
};

/// Where results of one light field go.
struct Output {
  fs::path folder;
  std::string prefix;  ///< of file names: "", "left-", "near-eye-1-vc-"
  Columns columns;     ///< of its rows
};

NearEyeDisplay display_for(const ReprojectOptions& options) {
  const NearEyeDisplay display;
  return options.optics == "thin-lens" ? consistent_with_thin_lenses(display) : display;
}

NearEyeDisplay display_for(const ReprojectOptions& options, const SubimageLayout& layout) {
  NearEyeDisplay display = display_for(options);
  display.columns = layout.columns;
  display.rows = layout.rows;
  return display;
}

ReprojectionOptions reprojection_of(const ReprojectOptions& options) {
  return {options.method == "one-step" ? ReprojectionMethod::kOneStep : ReprojectionMethod::kTwoStep,
          hole_fill_named(options.holes), false, options.common.threads};
}

Eye eye_of(const ReprojectOptions& options) {
  Eye eye{.pupil_mm = options.pupil_mm, .focus_mm = 1000 * options.focus_m};
  const std::vector<std::string> parts = split_list(options.eye);
  const auto wrong = [&] {
    return UsageError(
        fmt::format("--eye: give the position as X,Y,Z in mm, e.g. 0,0,0, not '{}'", options.eye));
  };
  if (parts.size() != 3) throw wrong();
  const std::array<double*, 3> targets{&eye.x_mm, &eye.y_mm, &eye.z_mm};
  for (std::size_t i = 0; i < 3; ++i) {
    char* end = nullptr;
    *targets[i] = std::strtod(parts[i].c_str(), &end);
    if (end == parts[i].c_str() || *end != '\0' || !std::isfinite(*targets[i])) throw wrong();
  }
  return eye;
}

/// light-field.png, panel.png and centre.png; retina.png if an eye was asked for.
void write_pictures(const Made& made, const DisplayImage& subimages, const ReprojectOptions& options,
                    const Output& output) {
  SubimageLayout small = made.layout;
  small.size_px /= made.supersampling;
  const auto path = [&](const char* name) { return output.folder / (output.prefix + name); };
  const DisplayImage panel = panel_image(subimages, small, made.display, options.common.threads);
  const auto [column, row] = central_position(small);
  write_display_image(path("panel.png"), panel);
  write_display_image(path("centre.png"), subimage(subimages, small, column, row));
  if (options.image_set) return;
  write_display_image(path("light-field.png"), subimages);
  if (options.eye.empty()) return;
  write_display_image(path("retina.png"), retinal_image(panel, made.display, eye_of(options),
                                                        {.threads = options.common.threads}));
}

void add_difference_rows(ResultTable& table, const Columns& columns, const DisplayImage& truth,
                         const DisplayImage& image) {
  const auto statistics = difference_statistics(truth, image);
  for (std::size_t c = 0; c < 3; ++c) {
    Columns with = columns;
    with.emplace_back("channel", std::string(1, "rgb"[c]));
    table.add({"difference_min", statistics[c].min, "1", with});
    table.add({"difference_max", statistics[c].max, "1", with});
    table.add({"difference_mean", statistics[c].mean, "1", with});
    table.add({"difference_median", statistics[c].median, "1", with});
  }
}

void add_reprojection_rows(ResultTable& table, const Columns& columns, const ReprojectionResult& result) {
  table.add({"seconds_reprojection", result.seconds, "s", columns});
  table.add({"holes", static_cast<double>(result.holes), "px", columns});
  const double share =
      result.pixels == 0 ? 0 : static_cast<double>(result.holes) / static_cast<double>(result.pixels);
  table.add({"hole_share", share, "1", columns});
  if (result.ignored_pixels > 0)
    table.add({"ignored_pixels", static_cast<double>(result.ignored_pixels), "px", columns});
}

/// Reprojects and writes one light field; `truth` gives every camera rendered, when it is needed.
template <class Truth>
void make_one(ResultTable& table, Made made, const CameraArray& array,
              const std::vector<RenderedCamera>& cameras, Truth truth, const ReprojectOptions& options,
              const Output& output) {
  const int threads = options.common.threads;
  const bool direct = options.method == "direct";
  if (direct) {
    const DirectLightField all = truth();
    made.light_field = all.light_field;
    if (all.seconds > 0) table.add({"seconds_direct", all.seconds, "s", output.columns});
  } else {
    ReprojectionResult result = reproject(array, cameras, reprojection_of(options));
    add_reprojection_rows(table, output.columns, result);
    made.light_field = std::move(result.light_field);
  }
  const DisplayImage image = to_subimages(made.light_field, made.layout, made.supersampling, threads);
  write_pictures(made, image, options, output);
  if (!options.compare || direct) return;
  const DirectLightField all = truth();
  if (all.seconds > 0) table.add({"seconds_direct", all.seconds, "s", output.columns});
  const DisplayImage reference = to_subimages(all.light_field, made.layout, made.supersampling, threads);
  add_difference_rows(table, output.columns, reference, image);
  write_display_image(output.folder / (output.prefix + "vc-light-field.png"), reference);
  write_display_image(output.folder / (output.prefix + "difference.png"),
                      difference_picture(reference, image, 4));
}

/// `exposure` > 0 replaces the scene's own.
void make_scene(ResultTable& table, const Scene& scene, const ReprojectOptions& options, const Output& output,
                float exposure = 0) {
  const double fov = options.optics == "thin-lens" ? display_for(options).rendered_fov_deg : 0;
  NearEyeScene prepared = prepare_near_eye(DirectScene(scene), options.supersampling, fov);
  if (exposure > 0) prepared.exposure = exposure;
  const CameraArray array = camera_array(prepared.grid);
  const Stopwatch watch;
  const std::vector<RenderedCamera> cameras =
      options.method == "direct" ? std::vector<RenderedCamera>{}
                                 : render_cameras(prepared, options.cameras, options.common.threads);
  if (options.method != "direct") table.add({"seconds_cameras", watch.seconds(), "s", output.columns});
  make_one(
      table, {{}, array.layout, options.supersampling, display_for(options, array.layout)}, array, cameras,
      [&] { return render_directly(prepared, options.common.threads); }, options, output);
}

void make_field(ResultTable& table, const LightField& field, const ReprojectOptions& options,
                const Output& output) {
  const CameraArray array = camera_array(field.grid());
  if (array.layout.size_px % options.supersampling != 0)
    throw UsageError(fmt::format("--supersampling: views of {} px cannot be divided by {}",
                                 array.layout.size_px, options.supersampling));
  const float exposure = exposure_from(field.view(0, 0)->colour);
  NearEyeDisplay display = display_for(options, array.layout);
  display.rendered_fov_deg = array.fov_deg;
  make_one(
      table, {{}, array.layout, options.supersampling, display}, array,
      cameras_of(field, options.cameras, exposure), [&] { return directly_from(field, exposure); }, options,
      output);
}

/// Both eyes: the cameras moved sideways, each eye at its own display, exposed alike.
void make_stereo(ResultTable& table, Scene scene, const ReprojectOptions& options, const Output& output) {
  const float exposure = prepare_near_eye(DirectScene(scene), 1).exposure;
  const Vec3 centre = scene.camera.centre_m, right = scene.camera.forward.cross(scene.camera.up);
  for (const int side : {-1, 1}) {
    scene.camera.centre_m =
        centre + right * (static_cast<float>(side) * static_cast<float>(options.stereo_mm) / 2000);
    const std::string eye = side < 0 ? "left" : "right";
    Output one{output.folder, eye + "-", output.columns};
    one.columns.emplace_back("eye", eye);
    make_scene(table, scene, options, one, exposure);
  }
}

/// VC and IC of the five scenes, for the sessions of a study.
void make_image_set(ResultTable& table, const ReprojectOptions& options, const fs::path& folder) {
  for (const SceneEntry& entry : near_eye_scenes())
    for (const bool direct : {true, false}) {
      ReprojectOptions one = options;
      const std::string kind = direct ? "vc" : "ic";
      if (direct) one.method = "direct";
      make_scene(table, entry.build(), one,
                 {folder,
                  fmt::format("{}-{}-", entry.id, kind),
                  {{"scene", std::string(entry.id)}, {"image", kind}}});
    }
}

void make_all(ResultTable& table, const ReprojectOptions& options, const fs::path& folder) {
  if (options.image_set) return make_image_set(table, options, folder);
  const Output output{folder, "", {{"source", options.source}, {"method", options.method}}};
  if (fs::exists(options.source)) return make_field(table, open_radiance(options.source), options, output);
  const Scene scene = scene_named(options.source);
  if (options.stereo_mm > 0) return make_stereo(table, scene, options, output);
  make_scene(table, scene, options, output);
}

void require_consistent(const ReprojectOptions& options) {
  if (options.image_set != options.source.empty())
    throw UsageError(options.image_set ? "--image-set renders its own five scenes: leave out the source"
                                       : "name a scene or the folder of a light field, or use --image-set");
  if (options.image_set && (options.method == "direct" || options.stereo_mm > 0 || !options.eye.empty()))
    throw UsageError(
        "--image-set writes both kinds of images: leave out --method direct, --stereo and --eye");
  if (options.method == "direct" && options.compare)
    throw UsageError(
        "--compare sets reprojection against every camera rendered, which --method direct is already: leave "
        "out one of them");
  if (!options.eye.empty()) eye_of(options).validate(display_for(options));
  if (options.source.empty() || fs::exists(options.source)) {
    if (options.stereo_mm > 0) throw UsageError("--stereo renders a second eye: name a scene, not a folder");
    return;
  }
  if (fs::path(options.source).has_parent_path())
    throw InputError(fmt::format("{} does not exist", options.source));
  scene_named(options.source);
}

void run_reproject(const Invocation& invocation, const ReprojectOptions& options) {
  require_consistent(options);
  Provenance provenance = begin_run(invocation, options.common);
  if (!options.source.empty() && fs::exists(options.source)) add_input(provenance, options.source);
  provenance.parameters["cameras"] = static_cast<long long>(options.cameras);
  provenance.parameters["method"] = options.method;
  provenance.parameters["holes"] = options.holes;
  provenance.parameters["supersampling"] = static_cast<long long>(options.supersampling);
  provenance.parameters["optics"] = options.optics;
  ResultTable table;
  const std::string item = options.image_set ? "--image-set" : options.source;
  write_result_folder({options.out, "reproject", item, options.force}, provenance,
                      [&](const fs::path& folder) { make_all(table, options, folder); });
  emit_results(table, provenance, options.common);
  tell(options.common, fmt::format("wrote {}", options.out));
}

void add_method_options(CLI::App& app, ReprojectOptions& options) {
  app.add_option("--cameras", options.cameras,
                 "Cameras that are rendered: the 4 corners, or 5 with a central one")
      ->check(one_of({"4", "5"}))
      ->capture_default_str();
  app.add_option("--method", options.method,
                 "two-step: rows, then columns; one-step: along slanted lines; direct: render every camera")
      ->check(one_of({"two-step", "one-step", "direct"}))
      ->capture_default_str();
  app.add_option("--holes", options.holes, "What pixels get that no rendered camera sees")
      ->check(one_of(hole_fill_names()))
      ->capture_default_str();
  app.add_option("--supersampling", options.supersampling,
                 "Rendered pixels per pixel of a subimage, across and down")
      ->check(one_of({"1", "2", "4"}))
      ->capture_default_str();
  app.add_option(
         "--optics", options.optics,
         "thesis: 19.86 degrees, subimages 80 1/3 px apart; thin-lens: both as the lens equation gives them")
      ->check(one_of({"thesis", "thin-lens"}))
      ->capture_default_str();
}

void add_eye_options(CLI::App& app, ReprojectOptions& options) {
  CLI::Option* eye = app.add_option(
      "--eye", options.eye,
      "Also write retina.png, what an eye at X,Y,Z mm from the middle of the eye box sees (0,0,0)");
  app.add_option("--focus", options.focus_m, "Distance in metres that this eye focuses on, or inf")
      ->check(positive_or_infinite())
      ->needs(eye)
      ->capture_default_str();
  app.add_option("--pupil", options.pupil_mm, "Diameter of its pupil in mm; 0 = pinhole")
      ->check(number_between(0, 20))
      ->needs(eye)
      ->capture_default_str();
  app.add_option("--stereo", options.stereo_mm, "Make both eyes, this many mm apart (files left-…, right-…)")
      ->check(number_between(0, 200));
}

}  // namespace

void add_reproject_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ReprojectOptions>();
  app.add_option("source", options->source,
                 "Scene id (near-eye-1 … near-eye-5, or another), or folder of a light field with square "
                 "views; cameras as "
                 "far apart down as across");
  app.add_option("-o,--out", options->out, "Folder for light-field.png, panel.png and centre.png")
      ->required()
      ->check(not_empty());
  add_method_options(app, *options);
  app.add_flag(
      "--compare", options->compare,
      "Also render every camera, write that and the difference (4 times brighter), and say how large it is");
  add_eye_options(app, *options);
  app.add_flag(
      "--image-set", options->image_set,
      "Panel and centre of the five scenes, every camera rendered (vc) and reprojected (ic), for sessions");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab reproject near-eye-3 -o results/near-eye-3 --compare --eye 0,0,0 --focus 0.8 "
      "--optics thin-lens\n"
      "          plenolab reproject --image-set -o results/images");
  app.callback([options, &invocation] { run_reproject(invocation, *options); });
}

}  // namespace plenolab
