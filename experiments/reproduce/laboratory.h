#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/synthesis/synthesizer.h"
#include "stimuli/render_cache.h"

namespace plenolab {

class LuminanceBench;
class MappingBench;
class NearEyeBench;
class WalkBench;
class OptimisationBench;

/// How large a reproduction is run.
enum class Effort {
  kTiny,   ///< a check that everything works: 3×3 views of 96 px, noisy; its numbers mean nothing
  kQuick,  ///< every scene's quick preset: minutes on two cores
  kPaper,  ///< every scene's paper preset: the thesis' grids, hours to days on two cores
};

/// "tiny", "quick" or "paper".
const char* name_of(Effort effort);

/// How much rendering a run has caused.
struct RenderingTally {
  int rendered = 0, from_cache = 0;
  double seconds = 0;
  std::uint64_t rays = 0;
};

struct LaboratoryOptions {
  Effort effort = Effort::kQuick;
  std::filesystem::path cache;  ///< folder of rendered views
  std::uint64_t seed = 1;
  int threads = 0;
  std::function<void(const RenderingTally&)> on_view;  ///< called after each view; may be empty
};

/// Positions at which every scene is scored, so that their ground truth is rendered once: in the middle cell,
/// its centre, the middle of its upper edge, and a place off every line of symmetry. Those that the grid has.
std::vector<CameraPosition> scored_positions(const ViewGrid& grid);

/// What all reproductions of one run share: scenes, their light fields and ground truth, rendered once and
/// cached.
class Laboratory {
 public:
  explicit Laboratory(LaboratoryOptions options);
  ~Laboratory();

  const LaboratoryOptions& options() const { return options_; }

  /// Ids of the scenes on which geometry and appearance of synthesised views are judged (sections 3, 4
  /// and 6.1 of the thesis); those made for tone mapping are not among them.
  std::vector<std::string> scene_ids() const;
  const Scene& scene(const std::string& id);
  /// The grid at which the scene is recorded in this run.
  ViewGrid grid(const std::string& id);
  /// Paths per pixel of the scene's views in this run.
  int paths_per_pixel(const std::string& id);
  LightField light_field(const std::string& id);
  const Synthesizer& synthesizer(const std::string& id);
  /// The rendered view at a position of the scene's grid, with `path_factor` ≥ 1 times the paths of the key
  /// views, for truth with less noise (not in a tiny run).
  KeyView<SceneReferred> truth(const std::string& id, CameraPosition position, int path_factor = 1);
  /// Row `row` of the views at these positions, as in truth(): one image one pixel high for each. Costs no
  /// more than these rows, which do not count as views in the tally.
  std::vector<SceneImage> truth_rows(const std::string& id, const std::vector<CameraPosition>& positions,
                                     int row, int path_factor = 1);

  /// A view of any scene, e.g. a probe scene or an altered copy (set Scene::variant). `paths_per_pixel` ≥ 16,
  /// lowered to 16 in a tiny run. Another `seed_offset` gives the same view with independent noise.
  KeyView<SceneReferred> render(const Scene& scene, const ViewGrid& grid, CameraPosition position,
                                int paths_per_pixel, std::uint64_t seed_offset = 0);
  /// All key views of such a scene, rendered at once.
  LightField render_field(const Scene& scene, const ViewGrid& grid, int paths_per_pixel,
                          std::uint64_t seed_offset = 0);
  /// The probe grid for this effort: `grid` itself, or a third of its image size in a tiny run.
  ViewGrid scaled(ViewGrid grid) const;

  /// What the items on tone mapping share (experiments/reproduce/tonemap).
  MappingBench& mapping_bench();
  /// What the items on the near-eye display share (experiments/reproduce/display).
  NearEyeBench& near_eye_bench();
  /// What the items on the luminance of a projector display share (experiments/reproduce/luminance).
  LuminanceBench& luminance_bench();
  /// What the items on look-up tables in a scene share (experiments/reproduce/lut).
  WalkBench& walk_bench();
  /// What the items on tone mapping tuned by metrics share (experiments/reproduce/optimisation).
  OptimisationBench& optimisation_bench();

  const RenderingTally& tally() const { return tally_; }

 private:
  struct SceneState;
  SceneState& state(const std::string& id);
  const PreparedScene& prepared(const Scene& scene);
  RenderSettings settings(int paths_per_pixel, std::uint64_t seed_offset = 0) const;
  KeyView<SceneReferred> render_prepared(const PreparedScene& scene, const ViewGrid& grid,
                                         CameraPosition position, int paths_per_pixel,
                                         std::uint64_t seed_offset = 0);

  LaboratoryOptions options_;
  std::map<std::string, std::unique_ptr<SceneState>> scenes_;
  std::map<std::string, PreparedScene> prepared_variants_;
  std::unique_ptr<MappingBench> mapping_bench_;
  std::unique_ptr<NearEyeBench> near_eye_bench_;
  std::unique_ptr<LuminanceBench> luminance_bench_;
  std::unique_ptr<WalkBench> walk_bench_;
  std::unique_ptr<OptimisationBench> optimisation_bench_;
  std::mutex tally_mutex_;
  RenderingTally tally_;
};

}  // namespace plenolab
