#include "core/luminance/display_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "core/io/json_reader.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kFile = "display.json";
constexpr const char* kFormat = "plenolab-display";
constexpr std::size_t kMostProjectors = 10'000;

ProjectorDisplayOptions display_of(const JsonReader& reader) {
  ProjectorDisplayOptions display;
  const JsonReader screen = reader.object("screen"), observers = reader.object("observers"),
                   projectors = reader.object("projectors");
  screen.allow_only({"width_m", "height_m"});
  observers.allow_only({"distance_m", "half_range_m"});
  projectors.allow_only({"distance_m", "layout"});
  display.space.width_m = screen.positive("width_m");
  display.space.height_m = screen.positive("height_m");
  display.space.observer_distance_m = observers.positive("distance_m");
  display.space.x_max_m = observers.positive("half_range_m");
  display.space.x_min_m = -display.space.x_max_m;
  display.projector_distance_m = projectors.positive("distance_m");
  const std::string layout = projectors.text("layout");
  if (layout != "line" && layout != "arc") projectors.wrong("layout", "must be \"line\" or \"arc\"");
  display.layout =
      layout == "arc" ? ProjectorDisplayOptions::Layout::kArc : ProjectorDisplayOptions::Layout::kLine;
  return display;
}

/// File names inside the folder, never a way out of it.
std::vector<std::string> images_of(const JsonReader& reader) {
  std::vector<std::string> names = reader.texts("images", kMostProjectors);
  if (names.empty()) reader.wrong("images", "must name at least one image");
  for (const std::string& name : names)
    if (fs::path(name).is_absolute() || fs::path(name).lexically_normal().string().starts_with(".."))
      reader.wrong("images", fmt::format("must name files inside the folder, not '{}'", name));
  return names;
}

std::string image_name(int k) {
  return fmt::format("projector-{:03}.exr", k);
}

}  // namespace

bool is_display_folder(const fs::path& folder) {
  return fs::is_regular_file(folder / kFile);
}

DisplayFolder read_display_folder(const fs::path& folder) {
  const std::string name = (folder / kFile).string();
  const nlohmann::json json = parse_json(read_text_file(folder / kFile), name, 4);
  const JsonReader reader(json, name, "");
  if (reader.text("format") != kFormat) reader.wrong("format", fmt::format("must be \"{}\"", kFormat));
  reader.integer("version", 1, 1);
  reader.allow_only({"format", "version", "screen", "observers", "projectors", "images"});
  DisplayFolder result{display_of(reader), {}};
  const std::vector<std::string> names = images_of(reader);
  result.display.projectors = static_cast<int>(names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const SceneImage image = read_scene_image(folder / names[k]);
    if (k == 0) {
      result.display.width = image.width();
      result.display.height = image.height();
      result.rays = SceneRays(ProjectorDisplay(result.display).size());
    }
    if (image.width() != result.display.width || image.height() != result.display.height)
      throw InputError(fmt::format("{} has {} × {} pixels, but the first projector's image {} × {}",
                                   (folder / names[k]).string(), image.width(), image.height(),
                                   result.display.width, result.display.height));
    set_image(result.rays, static_cast<int>(k), image);
  }
  return result;
}

void write_display_folder(const fs::path& folder, const ProjectorDisplay& display, const SceneRays& rays) {
  const ProjectorDisplayOptions& options = display.options();
  const DisplaySpace& space = options.space;
  if (space.x_min_m != -space.x_max_m)
    throw InputError("a display folder can only say how far observers stand to both sides alike");
  nlohmann::ordered_json json{
      {"format", kFormat},
      {"version", 1},
      {"screen", {{"width_m", space.width_m}, {"height_m", space.height_m}}},
      {"observers", {{"distance_m", space.observer_distance_m}, {"half_range_m", space.x_max_m}}},
      {"projectors",
       {{"distance_m", options.projector_distance_m},
        {"layout", options.layout == ProjectorDisplayOptions::Layout::kArc ? "arc" : "line"}}}};
  for (int k = 0; k < options.projectors; ++k) {
    write_scene_image(folder / image_name(k), image_of(rays, k), 1.0);
    json["images"].push_back(image_name(k));
  }
  write_text_file(folder / kFile, json.dump(2) + "\n");
}

}  // namespace plenolab
