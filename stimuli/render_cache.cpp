#include "stimuli/render_cache.h"

#include <fmt/format.h>
#include <stimuli_sources.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/io/exr.h"

namespace plenolab {

namespace {

namespace fs = std::filesystem;

// Raised when the layout of cached files or of the key changes.
constexpr double kCacheVersion = 1;
const std::vector<std::string> kChannels{"R", "G", "B", "disparity"};

bool all_finite(const std::vector<Plane<float>>& planes) {
  return std::all_of(planes.begin(), planes.end(), [](const Plane<float>& plane) {
    return std::all_of(plane.pixels().begin(), plane.pixels().end(),
                       [](float v) { return std::isfinite(v) && v >= 0; });
  });
}

// The view in a cache file; nothing if the file is missing, damaged or of another size.
std::optional<KeyView<SceneReferred>> load_entry(const fs::path& path, const ViewGrid& grid) {
  if (!fs::exists(path)) return std::nullopt;
  std::vector<Plane<float>> planes;
  try {
    planes = read_exr_channels(path, kChannels);
  } catch (const InputError&) {
    return std::nullopt;  // damaged: rendered again and replaced
  }
  if (planes[0].width() != grid.width || planes[0].height() != grid.height || !all_finite(planes))
    return std::nullopt;
  KeyView<SceneReferred> view{SceneImage(grid.width, grid.height), std::move(planes[3])};
  const auto pixels = view.colour.pixels();
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = {planes[0].pixels()[i], planes[1].pixels()[i], planes[2].pixels()[i]};
  return view;
}

fs::path entry_path(const fs::path& folder, const Scene& scene, const std::string& key) {
  return folder / (scene.id.empty() ? "unnamed" : scene.id) / (key + ".exr");
}

}  // namespace

std::string scene_source_hash(const std::string& scene_id) {
  std::string stem = scene_id;
  std::replace(stem.begin(), stem.end(), '-', '_');
  ContentHash hash;
  hash.add(stimuli_sources::kCommonHash);
  const auto& sources = stimuli_sources::kScenes;
  const auto own =
      std::find_if(std::begin(sources), std::end(sources), [&](const auto& s) { return stem == s.stem; });
  if (own != std::end(sources) && !stem.empty()) {
    hash.add(own->hash);
  } else {
    for (const auto& source : sources) hash.add(source.hash);
  }
  return hash.hex();
}

std::string render_cache_key(const Scene& scene, const ViewGrid& grid, CameraPosition position,
                             const RenderSettings& settings) {
  ContentHash hash;
  hash.add(kCacheVersion);
  hash.add(scene_source_hash(scene.id));
  hash.add(scene.id);
  hash.add(scene.variant);
  for (const double v : {static_cast<double>(grid.columns), static_cast<double>(grid.rows), grid.spacing_x_m,
                         grid.spacing_y_m, static_cast<double>(grid.width), static_cast<double>(grid.height),
                         grid.fov_h_deg, position.s + 0.0, position.t + 0.0, settings.blocks.t1_px,
                         settings.blocks.t2_px, static_cast<double>(settings.paths_per_pixel),
                         static_cast<double>(settings.row_begin), static_cast<double>(settings.row_end)})
    hash.add(v);
  hash.add_bytes(&settings.seed, sizeof settings.seed);
  return hash.hex();
}

CachedView render_view_cached(const PreparedScene& scene, const ViewGrid& grid, CameraPosition position,
                              const RenderSettings& settings, const fs::path& cache_folder,
                              const Progress& progress) {
  if (cache_folder.empty()) return {render_view(scene, grid, position, settings, progress), false};
  const fs::path path =
      entry_path(cache_folder, scene.scene(), render_cache_key(scene.scene(), grid, position, settings));
  if (auto view = load_entry(path, grid)) return {{std::move(*view), {}}, true};
  CachedView result{render_view(scene, grid, position, settings, progress), false};
  ExrWriteOptions options;
  options.colour_type = ExrPixelType::kFloat;
  const auto& view = result.rendered.view;
  write_exr(path, view.colour, {{kChannels[3], &view.disparity}}, options);
  return result;
}

LightField render_light_field(const Scene& scene, const ViewGrid& grid, const RenderSettings& settings,
                              const fs::path& cache_folder, const Progress& view_progress,
                              std::size_t memory_bound_bytes) {
  grid.validate();
  settings.validate();
  const auto load = [=, prepared = PreparedScene(scene)](int column, int row) {
    const CameraPosition position{static_cast<double>(column), static_cast<double>(row)};
    CachedView view = render_view_cached(prepared, grid, position, settings, cache_folder, view_progress);
    return std::move(view.rendered.view);
  };
  return LightField(grid, RadianceUnit::kCdM2, scene.id, load, memory_bound_bytes);
}

LightField render_light_field(const Scene& scene, Preset preset, RenderSettings settings,
                              const fs::path& cache_folder, const Progress& view_progress,
                              std::size_t memory_bound_bytes) {
  settings.paths_per_pixel = preset_of(scene, preset).paths_per_pixel;
  return render_light_field(scene, grid_of(scene, preset), settings, cache_folder, view_progress,
                            memory_bound_bytes);
}

}  // namespace plenolab
