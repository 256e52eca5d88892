#pragma once

#include <map>
#include <memory>
#include <string>

#include "experiments/reproduce/laboratory.h"
#include "experiments/reproduce/tonemap/motion.h"

namespace plenolab {

/// The motion over a scene that the thesis' figures 42 to 44 use: along the middle row of key views, for the
/// Dunes along the middle column (where the sun is hidden); ten frames a spacing (twenty along a column),
/// 30 frames a second.
Motion motion_over(const std::string& scene, const ViewGrid& grid);

/// What the items on tone mapping share during one run: statistics, mapped key views and motions of the
/// laboratory's scenes, each computed when first asked for and kept. References stay valid.
class MappingBench {
 public:
  explicit MappingBench(Laboratory& laboratory);

  const LightFieldStatistics& statistics(const std::string& scene);
  /// Key views mapped before synthesis (Mapping::place). Keeps the latest few only: hold on to what is used.
  std::shared_ptr<const MappedKeyViews> key_views(const std::string& scene, const Mapping& mapping);
  /// HDR views within every cell of the grid: at its centre and at a place off every line of symmetry.
  const std::vector<ReferenceFrame>& views_in_cells(const std::string& scene);
  /// motion_over the scene.
  const RecordedMotion& recording(const std::string& scene);
  /// The recording as a mapping shows it; its rows have the columns scene and mapping.
  const MappedMotion& motion(const std::string& scene, const Mapping& mapping);
  /// HDR frames of the scene with a mapping, in order; 30 frames a second for variants that map frames.
  void for_each_frame(const std::string& scene, const Mapping& mapping,
                      std::span<const ReferenceFrame> frames,
                      const std::function<void(std::size_t index, FrameMapping&& frame)>& receive);
  std::vector<DisplayImage> frames(const std::string& scene, const Mapping& mapping,
                                   std::span<const ReferenceFrame> frames);
  /// As motion(), for another recording of the scene; not kept.
  MappedMotion show(const std::string& scene, const RecordedMotion& recording, const Mapping& mapping);

  Laboratory& laboratory() { return laboratory_; }
  int threads() const;

 private:
  struct SceneState {
    std::optional<LightFieldStatistics> statistics;
    std::vector<ReferenceFrame> views_in_cells;
    std::optional<RecordedMotion> recording;
    std::map<std::string, MappedMotion> motions;
  };
  struct KeptKeyViews {
    std::string key;
    std::shared_ptr<const MappedKeyViews> views;
  };

  Laboratory& laboratory_;
  std::map<std::string, SceneState> scenes_;
  std::vector<KeptKeyViews> kept_;  ///< the latest last
};

}  // namespace plenolab
