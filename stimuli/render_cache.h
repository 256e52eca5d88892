#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "stimuli/render.h"

namespace plenolab {

/// Hash of the source text that decides how `scene_id` looks: everything below stimuli/ outside
/// stimuli/scenes/, the scene's own file stimuli/scenes/<id>.cpp (- in the id is _ in the name) with all it
/// includes from there, the random numbers, colour and camera model of core, and the versions of compiler and
/// Embree. Taken at build time (cmake/stimuli_sources.cmake has the rule), so a cached view does not outlive
/// the code that made it, while editing one scene leaves the views of the others valid. An id without a file
/// of its own depends on all scenes.
std::string scene_source_hash(const std::string& scene_id);

/// Name of a cached view: hash of the sources, the scene's id and variant, grid, position and settings (not
/// of the thread count and pruning, which do not change the result). 32 hexadecimal digits.
std::string render_cache_key(const Scene& scene, const ViewGrid& grid, CameraPosition position,
                             const RenderSettings& settings);

/// Where a view came from.
struct CachedView {
  RenderedView rendered;  ///< stats are zero when the view came from the cache
  bool from_cache = false;
};

/// Reads the view from `cache_folder`/<id>/<key>.exr (32-bit float, channels R, G, B, disparity), or renders
/// it and writes it there, whole or not at all. An entry that cannot be read, has another size or holds a
/// value that is not finite is rendered again and replaced. An empty folder name means no cache.
CachedView render_view_cached(const PreparedScene& scene, const ViewGrid& grid, CameraPosition position,
                              const RenderSettings& settings, const std::filesystem::path& cache_folder,
                              const Progress& progress = {});

/// The key views of a scene as a light field in cd/m²: each is taken from the cache or rendered when first
/// used, and kept within the memory bound. Throws InputError for a scene, grid or settings that do not
/// validate.
LightField render_light_field(const Scene& scene, const ViewGrid& grid, const RenderSettings& settings,
                              const std::filesystem::path& cache_folder, const Progress& view_progress = {},
                              std::size_t memory_bound_bytes = LightField::kDefaultMemoryBound);

/// The same for a preset of the scene, with its number of paths in place of settings.paths_per_pixel.
LightField render_light_field(const Scene& scene, Preset preset, RenderSettings settings,
                              const std::filesystem::path& cache_folder, const Progress& view_progress = {},
                              std::size_t memory_bound_bytes = LightField::kDefaultMemoryBound);

}  // namespace plenolab
