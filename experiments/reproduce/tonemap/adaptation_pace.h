#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace plenolab {

/// How fast and when a mapping adapts over a motion, from its adaptation_track (luma of surfaces under
/// unchanged light, added up from frame to frame).

/// How a change looks: classes of ours for what the thesis says in words, settled after a first look at the
/// tracks. A step is one of an 8-bit display (kSmallestStep).
enum class Pace {
  kSteady,   ///< less than a step within one spacing of key views
  kGradual,  ///< more, spread over the way between two key views or too slow to see from frame to frame
  kAbrupt,   ///< at least a step from one frame to the next, and all in less than half of that way
};

/// "steady", "gradual" or "abrupt".
const char* name_of(Pace pace);

struct Adaptation {
  double range = 0;            ///< largest less smallest value of the track, luma, ≥ 0
  double largest_step = 0;     ///< between neighbouring frames, luma, ≥ 0
  std::size_t steepest = 0;    ///< the second of these frames; 0 for fewer than two
  double largest_change = 0;   ///< within one spacing of key views around the largest step, luma, ≥ 0
  double duration_frames = 0;  ///< largest_change over largest_step: 1 for a change at once; 0 without one
  /// Of the changes of luma within one spacing before and one after the event, the share of those before it;
  /// 0 … 1. Nothing without a change or without a frame before it.
  std::optional<double> share_before;
  Pace pace = Pace::kSteady;
};

/// The track holds one value for each frame; light changes between frames `event` − 1 and `event` ≥ 1.
/// `frames_per_spacing` ≥ 1: frames of the motion from one key view to the next.
Adaptation adaptation_of(std::span<const double> track, std::size_t event, int frames_per_spacing);

}  // namespace plenolab
