#include "core/lut/volume_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/json_reader.h"
#include "core/lut/cube_file.h"

namespace plenolab {

namespace {

constexpr int kNesting = 8;
constexpr std::size_t kMostVolumes = 10000, kLongestPath = 4096;

double finite_number(const JsonReader& reader, const std::string& key, const nlohmann::json& json) {
  if (!json.is_number() || !std::isfinite(json.get<double>())) reader.wrong(key, "must hold finite numbers");
  return json.get<double>();
}

Point3 point(const JsonReader& reader, const std::string& key) {
  const nlohmann::json& json = reader.value(key);
  if (!json.is_array() || json.size() != 3) reader.wrong(key, "must be a list of three numbers (metres)");
  return {finite_number(reader, key, json[0]), finite_number(reader, key, json[1]),
          finite_number(reader, key, json[2])};
}

double number_or(const JsonReader& reader, const std::string& key, double otherwise) {
  return reader.has(key) ? finite_number(reader, key, reader.value(key)) : otherwise;
}

Volume parse_volume(const JsonReader& reader) {
  reader.allow_only({"name", "min", "max", "blend_radius_m", "weight", "lut"});
  return {reader.text("name"), point(reader, "min"), point(reader, "max"),
          number_or(reader, "blend_radius_m", 0), number_or(reader, "weight", 1)};
}

}  // namespace

VolumeScene parse_volumes(std::string_view json, const std::string& name) {
  const nlohmann::json document = parse_json(json, name, kNesting);
  const JsonReader reader(document, name, "");
  reader.allow_only({"format", "version", "background", "volumes"});
  if (reader.text("format") != "plenolab-volumes") reader.wrong("format", "must be \"plenolab-volumes\"");
  if (reader.integer("version", 1, 1000000) != 1)
    reader.wrong("version", "must be 1, the only version that this program reads");
  VolumeScene scene;
  if (reader.has("background")) scene.background = reader.text("background", kLongestPath);
  std::set<std::string> names;
  for (const JsonReader& entry : reader.objects("volumes", kMostVolumes)) {
    scene.volumes.push_back(parse_volume(entry));
    if (!names.insert(scene.volumes.back().name).second)
      throw InputError(fmt::format("{}: two volumes are named '{}'", name, scene.volumes.back().name));
    scene.tables.push_back(entry.text("lut", kLongestPath));
    try {
      scene.volumes.back().validate();
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", name, error.what()));
    }
  }
  return scene;
}

std::string volumes_text(const VolumeScene& scene) {
  PLENOLAB_CHECK(scene.volumes.size() == scene.tables.size(), "one table for each volume");
  nlohmann::ordered_json document{{"format", "plenolab-volumes"}, {"version", 1}};
  if (!scene.background.empty()) document["background"] = scene.background;
  document["volumes"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < scene.volumes.size(); ++i) {
    const Volume& volume = scene.volumes[i];
    volume.validate();
    document["volumes"].push_back({{"name", volume.name},
                                   {"min", volume.min},
                                   {"max", volume.max},
                                   {"blend_radius_m", volume.blend_radius_m},
                                   {"weight", volume.weight},
                                   {"lut", scene.tables[i]}});
  }
  return document.dump(2) + "\n";
}

LoadedVolumes read_volumes(const std::filesystem::path& path) {
  const VolumeScene scene = parse_volumes(read_text_file(path), path.string());
  LoadedVolumes loaded{scene.volumes, {}, {}, {}};
  const auto read = [&](const std::string& table) {
    loaded.files.push_back(path.parent_path() / table);
    return read_lut(loaded.files.back());
  };
  for (const std::string& table : scene.tables) loaded.tables.push_back(read(table));
  const Rgb low = loaded.tables.empty() ? Rgb{0, 0, 0} : loaded.tables.front().domain_min,
            high = loaded.tables.empty() ? Rgb{1, 1, 1} : loaded.tables.front().domain_max;
  loaded.background =
      scene.background.empty() ? identity_lut(kDefaultLutSize, low, high) : read(scene.background);
  return loaded;
}

}  // namespace plenolab
