#include "experiments/cli/display_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "core/base/error.h"
#include "core/lightfield/hci.h"
#include "core/lightfield/light_field_folder.h"
#include "core/luminance/display_folder.h"
#include "core/luminance/lens_array_display.h"
#include "core/luminance/multi_view_display.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/suggest.h"
#include "experiments/cli/viewing_options.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr int kPixelsPerLens = 8, kViews = 9;

DisplayPreset preset_of(const std::string& name) {
  if (name == "quick") return DisplayPreset::kQuick;
  if (name.empty() || name == "small") return DisplayPreset::kSmall;
  return name == "full" ? DisplayPreset::kFull : DisplayPreset::kPaper;
}

LensArrayDisplayOptions lens_array(const std::string& kind, const ProjectorDisplayOptions& size) {
  using Kind = LensArrayDisplayOptions::Kind;
  LensArrayDisplayOptions options{
      .width = kPixelsPerLens * size.width, .height = size.height, .lenses_across = size.width};
  if (kind == "barrier") options.kind = Kind::kParallaxBarrier;
  if (kind == "full-parallax") {
    options.kind = Kind::kFullParallax;
    options.space.y_min_m = -0.3;
    options.space.y_max_m = 0.3;
    options.height = kPixelsPerLens * size.height;
    options.lenses_down = size.height;
  }
  return options;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const LitSceneEntry& entry : display_scenes()) names.emplace_back(entry.id);
  return names;
}

/// The cameras of the middle row as views, as far apart as they stood.
ShownField views_of(const LightField& field, double cd_m2_per_unit, int threads) {
  const ViewGrid& grid = field.grid();
  const double half = grid.columns * grid.spacing_x_m / 2;
  MultiViewDisplayOptions options{.views = grid.columns, .width = grid.width, .height = grid.height};
  options.space.x_min_m = -half;
  options.space.x_max_m = half;
  auto display = std::make_shared<const MultiViewDisplay>(options);
  SceneRays rays(display->size());
  const auto scale = static_cast<float>(cd_m2_per_unit > 0 ? cd_m2_per_unit : 1);
  for (int column = 0; column < grid.columns; ++column) {
    SceneImage view = field.view(column, grid.rows / 2)->colour;
    for (Rgb& c : view.pixels()) c = c * scale;
    set_image(rays, column, view);
  }
  ShownField shown = show_rays(field.name(), std::move(display), std::move(rays), threads);
  shown.unit = cd_m2_per_unit > 0 ? RadianceUnit::kCdM2 : field.unit();
  return shown;
}

/// A folder without display.json must hold a light field.
void require_views(const std::string& source) {
  if (!fs::is_directory(source))
    throw InputError(fmt::format(
        "{} is not a folder: give the folder that holds display.json or lightfield.json", source));
  if (!is_light_field_folder(source) && !is_hci_folder(source))
    throw InputError(
        fmt::format("{} holds neither display.json, which describes projectors, nor a light field "
                    "(lightfield.json, or an HCI parameters.cfg)",
                    source));
}

/// Displays on a plane have the square of the samples.
void require_samples_of(const DisplayOptions& options) {
  try {
    observer_samples(*make_display(options), options);
  } catch (const InputError& error) {
    throw UsageError(fmt::format("--samples: {}", error.what()));
  }
}

}  // namespace

void add_display_options(CLI::App& app, DisplayOptions& options) {
  app.add_option("--display", options.kind, "Display that a scene is rendered for")
      ->check(one_of({"projectors", "multi-view", "lenticular", "barrier", "full-parallax"}))
      ->capture_default_str();
  app.add_option(
         "--preset", options.preset,
         "Size of the display that a scene is rendered for: quick (24 projectors, 160 x 90 px), small "
         "(default; 96, 160 x 90), full (96, 640 x 360), paper (96, 1280 x 720)")
      ->check(one_of({"quick", "small", "full", "paper"}));
  app.add_option("--samples", options.samples,
                 "Samples along the observers' line (default for projectors: 200, for full and paper 1000)")
      ->check(whole_number(1, 1'000'000));
  add_luminance_scale_option(app, options.cd_m2_per_unit, "without a statement, luminance is relative");
}

std::shared_ptr<const RayDisplay> make_display(const DisplayOptions& options) {
  const ProjectorDisplayOptions size = projector_display_options(preset_of(options.preset));
  if (options.kind == "projectors") return std::make_shared<const ProjectorDisplay>(size);
  if (options.kind == "multi-view")
    return std::make_shared<const MultiViewDisplay>(
        MultiViewDisplayOptions{.views = kViews, .width = size.width, .height = size.height});
  return std::make_shared<const LensArrayDisplay>(lens_array(options.kind, size));
}

ObserverSamples observer_samples(const RayDisplay& display, const DisplayOptions& options) {
  if (options.samples > 0) return samples_of(display, options.samples);
  if (dynamic_cast<const LensArrayDisplay*>(&display)) return samples_of(display, kPixelsPerLens);
  if (dynamic_cast<const MultiViewDisplay*>(&display)) return samples_of(display, display.size().images);
  // About 50 columns of rays a sample: fewer make accumulation noisy.
  return samples_of(display, display.size().width < 400 ? 200 : 1000);
}

bool is_display_scene(const std::string& source) {
  const std::vector<std::string> names = scene_names();
  return std::find(names.begin(), names.end(), source) != names.end();
}

void require_field_source(const std::string& source, const DisplayOptions& options) {
  const bool scene = is_display_scene(source);
  if (!scene && !fs::exists(source)) {
    const std::vector<std::string> names = scene_names();
    if (fs::path(source).has_parent_path()) throw InputError(fmt::format("{} does not exist", source));
    throw UsageError(fmt::format("there is no scene '{}' for displays{} (there are: {})", source,
                                 did_you_mean(source, names), fmt::join(names, ", ")));
  }
  if (!scene && options.kind != "projectors")
    throw UsageError("--display is for scenes: a folder brings its own display");
  if (!scene && !options.preset.empty())
    throw UsageError("--preset is for scenes: a folder brings its own display");
  if (scene && options.cd_m2_per_unit > 0)
    throw UsageError("--cd-m2-per-unit is for folders: scenes are in cd/m²");
  if (scene) require_samples_of(options);
}

ShownField open_field(const std::string& source, const DisplayOptions& options,
                      const RayRendering& rendering) {
  if (is_display_scene(source))
    return show_scene(build_display_scene(source), make_display(options), rendering);
  if (is_display_folder(source)) {
    const double scale = options.cd_m2_per_unit;
    DisplayFolder folder = read_display_folder(source, scale > 0 ? std::optional(scale) : std::nullopt);
    return show_rays(source, std::make_shared<const ProjectorDisplay>(folder.display), std::move(folder.rays),
                     rendering.threads);
  }
  require_views(source);
  return views_of(open_radiance(source), options.cd_m2_per_unit, rendering.threads);
}

}  // namespace plenolab
