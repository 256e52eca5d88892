#pragma once

#include <string>
#include <vector>

#include "analysis/epi.h"
#include "core/synthesis/synthesizer.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/frame_mapper.h"
#include "experiments/tonemap_consistency.h"
#include "experiments/tonemap_video.h"

namespace plenolab {

/// Camera motions over a light field, and what tone mapping makes of them: the common ground of the figures
/// and claims on consistency (thesis of Altmeier, sections 5.1 to 5.3 and 6.2).

/// One way to show a light field: an operator with its place in the pipeline.
struct Mapping {
  std::string label;  ///< in pictures and tables, e.g. "Reinhard 2005, naive"
  OperatorChoice choice;
  AdaptationOptions adaptation;  ///< of variants for frames
  BorderWeight border_weight = BorderWeight::kPrinted;

  MappingPlace place() const { return default_place(choice); }
  /// Equal for equal mappings whatever their labels.
  std::string key() const;
};

/// A mapping as typed on the command line: mapping_of("Joint", "reinhard05", "joint", {"b=-1"}).
Mapping mapping_of(std::string label, const std::string& name, const std::string& variant,
                   const std::vector<std::string>& settings = {});

/// A straight camera motion over the grid.
struct Motion {
  CameraPosition from, to;
  int frames = 41;
  double frames_per_second = 30;

  bool vertical() const { return from.s == to.s && from.t != to.t; }
};

/// Frames from one key view to the next, at least 1.
int frames_per_spacing(const Motion& motion);

/// Log10 of the largest finite luminance of a view; −300 for one without light.
double log_peak(const SceneImage& view);

/// The HDR frames of a motion, synthesised once, which all mappings are judged against.
struct RecordedMotion {
  Motion motion;
  std::vector<ReferenceFrame> frames;
  /// Row (column, if the motion is vertical) of the epipolar images: the one that crosses most borders of
  /// visibility over all frames.
  int epi_line = 0;
  /// The two frames between which the largest HDR luminance changes most (log10): where a light appears or is
  /// hidden. `event` is the second of them, ≥ 1.
  std::size_t event = 1;

  EpiDirection epi_direction() const {
    return motion.vertical() ? EpiDirection::kColumn : EpiDirection::kRow;
  }
};

/// At least two frames.
RecordedMotion record_motion(const Synthesizer& synthesizer, const Motion& motion, int threads);

/// Every `stride`-th frame of a recording: the same motion at `stride` times the speed.
RecordedMotion faster(const RecordedMotion& recording, int stride);

/// Key views mapped before synthesis.
struct MappedKeyViews {
  DisplayLightField field;
  std::vector<FitSummary> fits;   ///< one, or one for each view row by row
  std::vector<double> mean_luma;  ///< of each view row by row
  MappingCounts counts;           ///< before adjustment
};

/// All in memory. The mapping must stand before synthesis.
MappedKeyViews map_key_views(const LightField& field, const LightFieldStatistics& statistics,
                             const Mapping& mapping, int threads);

/// A motion as a mapping shows it.
struct MappedMotion {
  std::vector<FrameConsistency> frames;  ///< what each adds, see ConsistencyMeter
  ResultTable summary;                   ///< of ConsistencyMeter, with the columns given to map_motion
  LumaTrack track;
  DisplayImage epi;                            ///< at RecordedMotion::epi_line
  DisplayImage first, before, event, last;     ///< frames 0, event − 1, event and the last
  std::vector<std::vector<FittedValue>> fits;  ///< of each frame, for variants that map frames
};

/// Shows the recorded motion with a mapping. `key_views` are used by mappings that stand before synthesis and
/// may be null for others.
MappedMotion map_motion(const LightField& field, const LightFieldStatistics& statistics,
                        const RecordedMotion& recording, const Mapping& mapping,
                        const MappedKeyViews* key_views, const Columns& columns, int threads);

/// Shows HDR frames with a mapping, in order; variants for frames take them as a motion.
void for_each_mapped_frame(const LightField& field, const LightFieldStatistics& statistics,
                           std::span<const ReferenceFrame> frames, double frames_per_second,
                           const Mapping& mapping, const MappedKeyViews* key_views, int threads,
                           const std::function<void(std::size_t index, FrameMapping&& frame)>& receive);

}  // namespace plenolab
