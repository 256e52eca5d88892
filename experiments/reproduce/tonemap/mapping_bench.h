#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "experiments/reproduce/laboratory.h"
#include "experiments/reproduce/tonemap/motion.h"

namespace plenolab {

/// Parallel motions over each scene, from one side of the grid to the other: in the middle and halfway from
/// there to either edge of the grid.
inline constexpr int kMotionLines = 3, kMiddleLine = 1;

/// Views that MappingBench has of every cell of a grid. Those of one cell share its key views: claims draw
/// them together.
inline constexpr int kViewsInCell = 2, kViewsOfBorders = 4;

/// The motion over a scene that the thesis' figures 42 to 44 use: along the middle row of key views, for the
/// Dunes along the middle column (where the sun is hidden); ten frames a spacing (twenty along a column),
/// 30 frames a second. Other lines, in [0, kMotionLines), run parallel to it.
Motion motion_over(const std::string& scene, const ViewGrid& grid, int line = kMiddleLine);

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
  /// HDR views a tenth of a spacing from the corners of every cell, kViewsOfBorders of each: one key view
  /// dominates there, and others take over beyond its border.
  const std::vector<ReferenceFrame>& views_near_key_views(const std::string& scene);
  /// motion_over the scene.
  const RecordedMotion& recording(const std::string& scene, int line = kMiddleLine);
  /// The recording as a mapping shows it; its rows have the columns scene and mapping.
  const MappedMotion& motion(const std::string& scene, const Mapping& mapping, int line = kMiddleLine);
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
    std::vector<ReferenceFrame> views_in_cells, views_near_key_views;
    std::array<std::optional<RecordedMotion>, kMotionLines> recordings;
    std::map<std::pair<int, std::string>, MappedMotion> motions;  ///< by line and mapping
  };
  struct KeptKeyViews {
    std::string key;
    std::shared_ptr<const MappedKeyViews> views;
  };

  /// Fills `views`, if empty, with HDR views at the offsets within every cell.
  const std::vector<ReferenceFrame>& fill_views(const std::string& scene,
                                                std::span<const CameraPosition> offsets,
                                                std::vector<ReferenceFrame>& views);

  Laboratory& laboratory_;
  std::map<std::string, SceneState> scenes_;
  std::vector<KeptKeyViews> kept_;  ///< the latest last
};

}  // namespace plenolab
