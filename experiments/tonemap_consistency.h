#pragma once

#include <cstdint>
#include <optional>

#include "analysis/result_table.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/score.h"
#include "metrics/consistency.h"

namespace plenolab {

/// One HDR frame of a camera motion, which tone mapped ones are judged against, and what the synthesis knows
/// of it.
struct ReferenceFrame {
  CameraPosition position;
  SceneImage hdr;
  DisparityMap disparity_px;
  Plane<std::uint8_t> contributors;  ///< see contributing_views
};

/// Synthesises the HDR frame at a position of the synthesizer's grid, with provenance.
ReferenceFrame reference_frame(const Synthesizer& synthesizer, CameraPosition position,
                               SynthesisOptions options);

/// Share of the pixels that must take part for a change of luma between two views to count.
inline constexpr double kEnoughOfAFrame = 0.05;

/// What one frame adds.
struct FrameConsistency {
  std::optional<LineChange> change;  ///< since the frame before; nothing for the first
  BorderChange borders;
};

/// Consistency of the frames of a camera motion, handed over in order; keeps one of them.
class ConsistencyMeter {
 public:
  /// For frames that were synthesised with these options on this grid.
  ConsistencyMeter(const ViewGrid& grid, const SynthesisOptions& synthesis, ConsistencyOptions options = {});

  FrameConsistency add(ReferenceFrame reference, const DisplayImage& mapped);

  /// Over all frames so far (quantity, unit, meaning):
  ///   line_change_rms      luma  change along epipolar lines where the light does not change
  ///   frame_change_max      luma  largest mean change of a whole frame, of those of which at least a
  ///                              twentieth took part: flicker
  ///   line_pixels          px    that both rest on
  ///   border_excess        1     borders of visibility in the mapped frames over those in the HDR frames
  ///   border_pairs         px    pairs across borders
  ///   motion_luma_min, motion_luma_max, motion_luma_step_max     luma
  ///   motion_log_luminance_step_max                          log10
  ///   adaptation_agreement 1     rank correlation of mean luma and mean log luminance
  /// Numbers that the motion does not give are left out.
  ResultTable summary(const Columns& columns) const;

  const LumaTrack& track() const { return track_; }

 private:
  struct Previous {
    ReferenceFrame reference;
    DisplayImage mapped;
  };
  double vertical_ratio_, screen_px_;
  ConsistencyOptions options_;
  std::optional<Previous> previous_;
  LumaTrack track_;
  double squared_change_ = 0, largest_change_ = 0;
  std::int64_t line_pixels_ = 0;
  BorderChange borders_;  ///< means over all pairs of all frames
};

/// Rows of one frame: line_change_mean, line_change_rms and line_share (not for the first, nor where no pixel
/// took part) and border_excess (where there is one).
void add_consistency_rows(ResultTable& table, const FrameConsistency& frame, const Columns& columns);

}  // namespace plenolab
