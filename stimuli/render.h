#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/pruned_stage.h"
#include "core/lightfield/light_field.h"
#include "stimuli/block_preprocess.h"
#include "stimuli/scene.h"

namespace plenolab {

/// Two sizes of every scene: one for a look, one for the figures.
enum class Preset { kQuick, kPaper };

/// The cameras and images of a scene in one preset.
ViewGrid grid_of(const Scene& scene, Preset preset);
const GridPreset& preset_of(const Scene& scene, Preset preset);

/// How to render a view of a given grid.
struct RenderSettings {
  int paths_per_pixel =
      64;  ///< per delivered pixel, a multiple of 16: each of the 4 × 4 samples gets a 16th of them
  std::uint64_t seed = 1;  ///< of all randomness; noise also differs from pixel to pixel and camera to camera
  int threads = 0;         ///< 0 = all cores; no influence on the result
  bool prune = true;       ///< leave out the stages a scene does not need; no influence on the result
  /// Only the delivered rows from row_begin up to, not including, row_end are rendered, each as in the whole
  /// view, and the others are 0: for slices of many views. row_end = 0: up to the last row.
  int row_begin = 0, row_end = 0;
  BlockOptions blocks;

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

struct RenderStats {
  std::uint64_t camera_rays = 0;
  std::uint64_t bounce_rays = 0;  ///< that continue a path
  std::uint64_t shadow_rays = 0;  ///< towards sun, sky and lamps
  double seconds = 0;             ///< wall clock of the rendering, without scene preparation
  std::vector<PrunedStage> pruned;

  std::uint64_t rays() const { return camera_rays + bounce_rays + shadow_rays; }
  double mrays_per_second() const;
};

/// A scene made ready for rays: acceleration structure, light distributions. Cheap to copy; copies share the
/// preparation, which is done when the first view is rendered, by whichever thread comes first: a scene all
/// of whose views are in the cache costs none.
class PreparedScene {
 public:
  /// Copies the scene. Throws InputError as validate() does.
  explicit PreparedScene(const Scene& scene);
  const Scene& scene() const;

  struct State;
  const State& state() const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

struct RenderedView {
  KeyView<SceneReferred> view;
  RenderStats stats;
};

/// Renders what the camera at `position` of `grid` records, on a key view or anywhere else on the camera
/// plane (also beyond the grid), with the same preprocessing everywhere: the ground truth of synthesised
/// views is this function too.
///
/// The camera stands at centre + (s − (columns−1)/2)·spacing_x·right − (t − (rows−1)/2)·spacing_y·up of
/// Scene::camera. Radiance is path tracing in cd/m², an unbiased estimate of the light of all paths of up to
/// Scene::max_bounces scattering events (without those Scene::caustics leaves out); nothing is clamped.
/// Disparity is that of the first surface along each camera ray, opaque or smooth dielectric (a water surface
/// counts, what lies below does not); the medium is no surface; sky has disparity 0. Inverse depths are
/// averaged within each of the 4 × 4 samples, then the block is reduced by preprocess_block.
///
/// The result depends on scene, grid, position, paths, seed and block options only, bit by bit.
RenderedView render_view(const PreparedScene& scene, const ViewGrid& grid, CameraPosition position,
                         const RenderSettings& settings, const Progress& progress = {});

/// The same before the reduction: images of 4× the width and height of the grid. Disparity in delivered
/// pixels.
struct SampledView {
  SceneImage radiance;
  DisparityMap disparity_px;
  RenderStats stats;
};
SampledView render_samples(const PreparedScene& scene, const ViewGrid& grid, CameraPosition position,
                           const RenderSettings& settings, const Progress& progress = {});

}  // namespace plenolab
