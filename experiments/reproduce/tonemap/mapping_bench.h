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
  /// motion_over the scene.
  const RecordedMotion& recording(const std::string& scene);
  /// The recording as a mapping shows it; its rows have the columns scene and mapping.
  const MappedMotion& motion(const std::string& scene, const Mapping& mapping);
  /// The same for another recording of the scene; not kept.
  MappedMotion show(const std::string& scene, const RecordedMotion& recording, const Mapping& mapping);

  Laboratory& laboratory() { return laboratory_; }
  int threads() const;

 private:
  struct SceneState {
    std::optional<LightFieldStatistics> statistics;
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
