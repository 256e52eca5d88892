#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduce/tonemap/mappings.h"

namespace plenolab {

/// Numbers of motions that claims compare, one of each line of a scene (kMotionLines of them, in order).

/// Largest change of the brightness of surfaces under unchanged light from one frame to the next (luma, ≥ 0).
std::vector<double> largest_steps(MappingBench& bench, const std::string& scene, const Mapping& mapping);
double largest_step(const MappedMotion& motion);

/// Range of the adaptation track: how far the mapping adapts over the motion (luma, ≥ 0).
std::vector<double> adaptation_ranges(MappingBench& bench, const std::string& scene, const Mapping& mapping);
double adaptation_range(const MappedMotion& motion);

/// How long before the event (RecordedMotion::event) the mapping has gone a tenth of the way that it goes
/// from `window` frames before to `window` frames after it, in seconds; negative if only afterwards. Nothing
/// if it goes less than the smallest step of an 8-bit display, or if the window does not fit into the motion
/// (it is cut, but both sides must have at least three frames).
std::optional<double> lead_time_s(const RecordedMotion& recording, const std::vector<double>& track,
                                  int window);

}  // namespace plenolab
