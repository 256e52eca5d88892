#include "core/luminance/display_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "core/io/json_reader.h"
#include "core/io/white_luminance.h"

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

void scale(SceneImage& image, double factor) {
  if (factor == 1) return;
  for (Rgb& c : image.pixels()) c = c * static_cast<float>(factor);
}

std::string image_name(int k) {
  return fmt::format("projector-{:03}.exr", k);
}

}  // namespace

DisplayDescription parse_display_description(std::string_view text, const std::string& name) {
  const nlohmann::json json = parse_json(text, name, 4);
  const JsonReader reader(json, name, "");
  if (reader.text("format") != kFormat) reader.wrong("format", fmt::format("must be \"{}\"", kFormat));
  reader.integer("version", 1, 1);
  reader.allow_only({"format", "version", "screen", "observers", "projectors", "images"});
  DisplayDescription description{display_of(reader), images_of(reader)};
  description.display.projectors = static_cast<int>(description.images.size());
  try {
    description.display.validate();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  return description;
}

std::string format_display_description(const DisplayDescription& description) {
  const ProjectorDisplayOptions& display = description.display;
  const DisplaySpace& space = display.space;
  const nlohmann::ordered_json json{
      {"format", kFormat},
      {"version", 1},
      {"screen", {{"width_m", space.width_m}, {"height_m", space.height_m}}},
      {"observers", {{"distance_m", space.observer_distance_m}, {"half_range_m", space.x_max_m}}},
      {"projectors",
       {{"distance_m", display.projector_distance_m},
        {"layout", display.layout == ProjectorDisplayOptions::Layout::kArc ? "arc" : "line"}}},
      {"images", description.images}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

bool is_display_folder(const fs::path& folder) {
  return fs::is_regular_file(folder / kFile);
}

DisplayFolder read_display_folder(const fs::path& folder, std::optional<double> cd_m2_per_unit) {
  const DisplayDescription description =
      parse_display_description(read_text_file(folder / kFile), (folder / kFile).string());
  DisplayFolder result{description.display, {}};
  for (std::size_t k = 0; k < description.images.size(); ++k) {
    const fs::path file = folder / description.images[k];
    SceneImage image = read_scene_image(file);
    scale(image, cd_m2_per_unit ? *cd_m2_per_unit : white_luminance(file).value_or(1));
    if (k == 0) {
      result.display.width = image.width();
      result.display.height = image.height();
      result.rays = SceneRays(ProjectorDisplay(result.display).size());
    }
    if (image.width() != result.display.width || image.height() != result.display.height)
      throw InputError(fmt::format("{} has {} × {} pixels, but the first projector's image {} × {}",
                                   file.string(), image.width(), image.height(), result.display.width,
                                   result.display.height));
    set_image(result.rays, static_cast<int>(k), image);
  }
  return result;
}

void write_display_folder(const fs::path& folder, const ProjectorDisplay& display, const SceneRays& rays) {
  const DisplaySpace& space = display.space();
  if (space.x_min_m != -space.x_max_m)
    throw InputError("a display folder can only say how far observers stand to both sides alike");
  DisplayDescription description{display.options(), {}};
  for (int k = 0; k < display.options().projectors; ++k) {
    description.images.push_back(image_name(k));
    write_scene_image(folder / description.images.back(), image_of(rays, k), 1.0);
  }
  write_text_file(folder / kFile, format_display_description(description));
}

}  // namespace plenolab
